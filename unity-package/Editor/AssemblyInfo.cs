using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Chamfer.Tests")]
