namespace Chamfer
{
    /// <summary>Where the package tells of itself; packing fills in the address of the repository.</summary>
    internal static class PackageLinks
    {
        internal const string Documentation = "Packages/com.chamfer.unity/Documentation~/index.md";
    }
}
