using System.Linq;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>Whether what a modifier made is still what it would make.</summary>
    internal static class ModifierState
    {
        /// <summary>Whether a source has changed since.</summary>
        internal static bool IsOutdated(ChamferModifier modifier)
        {
            return modifier.meshes.Any(IsOutdated);
        }

        /// <summary>Whether the source of a mesh has changed since.</summary>
        internal static bool IsOutdated(ChamferedMesh entry)
        {
            if (entry.original == null || string.IsNullOrEmpty(entry.sourceKey)) { return false; }
            string now = MeshKeys.Of(entry.original);
            return now != MeshKeys.Unknown && now != entry.sourceKey;
        }
    }
}
