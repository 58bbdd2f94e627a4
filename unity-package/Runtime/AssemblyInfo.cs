using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Chamfer.Editor")]
[assembly: InternalsVisibleTo("Chamfer.Tests")]
