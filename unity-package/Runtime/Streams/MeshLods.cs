using UnityEngine;
#if UNITY_EDITOR && UNITY_6000_2_OR_NEWER
using UnityEditor;
#endif

namespace Chamfer.Streams
{
    /// <summary>
    /// Levels of detail within a mesh, which Unity has since 6000.2. They are other triangles over the same vertices,
    /// so those of the source do not fit a chamfered mesh: the editor makes them anew, and players do without.
    /// </summary>
    internal static class MeshLods
    {
        /// <summary>How many levels a mesh has, itself included.</summary>
        internal static int Count(Mesh mesh)
        {
#if UNITY_6000_2_OR_NEWER
            return Mathf.Max(1, mesh.lodCount);
#else
            return 1;
#endif
        }

        /// <summary>Makes levels of a mesh that was just written.</summary>
        internal static void Make(Mesh mesh, int count)
        {
#if UNITY_EDITOR && UNITY_6000_2_OR_NEWER
            // The first is the mesh itself.
            if (count > 1) { MeshLodUtility.GenerateMeshLods(mesh, count - 1); }
#endif
        }
    }
}
