using System.Linq;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>At which height on the screen, as a share of the picture's, the source is shown again.</summary>
    internal static class LodHeight
    {
        /// <summary>A chamfer of one line of such a picture is still seen.</summary>
        private const float Lines = 1080;

        /// <summary>However narrow a chamfer is, it is shown near by; however wide, not for an object of some pixels.</summary>
        private const float Least = 0.02f;
        private const float Most = 0.5f;

        /// <summary>Where the chamfers of a modifier are one line of the picture wide.</summary>
        internal static float Of(ChamferModifier modifier)
        {
            float narrowest = modifier.meshes.Where(entry => entry.original != null).Min(entry => Share(entry));
            return Mathf.Clamp(1 / (Lines * narrowest), Least, Most);
        }

        /// <summary>A height within two others, and not on them.</summary>
        internal static float Between(float height, float below, float above)
        {
            return height > below && height < above ? height : (below + above) / 2;
        }

        /// <summary>The width as a share of the mesh's largest side.</summary>
        private static float Share(ChamferedMesh entry)
        {
            if (entry.settings.unit == WidthUnit.PercentOfExtent) { return entry.settings.width / 100; }
            var size = entry.original.bounds.size;
            var scale = entry.settings.edges.worldWidth ? entry.worldScale : new Vector3(1, 1, 1);
            float side = Mathf.Max(size.x * Mathf.Abs(scale.x), Mathf.Max(size.y * Mathf.Abs(scale.y), size.z * Mathf.Abs(scale.z)));
            return side > 0 ? entry.settings.width / side : 1;
        }
    }
}
