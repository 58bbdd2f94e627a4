using System.Linq;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>Whether what a modifier made is still what it would make.</summary>
    internal static class ModifierState
    {
        /// <summary>Whether a source, or the preset, has changed since.</summary>
        internal static bool IsOutdated(ChamferModifier modifier)
        {
            return modifier.meshes.Any(entry => IsOutdated(modifier, entry));
        }

        /// <summary>Whether a source, its scale where that counts, or the preset has changed since one mesh was made.</summary>
        internal static bool IsOutdated(ChamferModifier modifier, ChamferedMesh entry)
        {
            return IsOutdated(entry) || IsRescaled(entry) || modifier.preset != null && !IsMadeWith(entry, modifier.preset.settings);
        }

        /// <summary>A preview may have looked less closely.</summary>
        private static bool IsMadeWith(ChamferedMesh entry, ChamferSettings settings)
        {
            settings.verify = entry.settings.verify;
            return SettingsText.Of(settings) == SettingsText.Of(entry.settings);
        }

        private static bool IsRescaled(ChamferedMesh entry)
        {
            if (!entry.settings.edges.worldWidth || entry.holder == null) { return false; }
            var change = entry.holder.transform.lossyScale - entry.worldScale;
            // An object that is turned has a scale that is rounded otherwise.
            return change.magnitude > RoundingOfScale * entry.worldScale.magnitude;
        }

        private const float RoundingOfScale = 1e-4f;

        /// <summary>Whether the source of a mesh has changed since.</summary>
        private static bool IsOutdated(ChamferedMesh entry)
        {
            if (entry.original == null || string.IsNullOrEmpty(entry.sourceKey)) { return false; }
            string now = MeshKeys.Of(entry.original);
            return now != MeshKeys.Unknown && now != entry.sourceKey;
        }
    }
}
