using UnityEngine;
#if UNITY_EDITOR
using UnityEditor;
#endif

namespace Chamfer.Streams
{
    /// <summary>
    /// How Unity stores a mesh, which has nothing to do with its shape. Only the editor knows; in players, what can be
    /// chamfered is readable, and so is the result.
    /// </summary>
    internal static class MeshFlags
    {
#if UNITY_EDITOR
        private const string Readable = "m_IsReadable";

        private static readonly string[] copied = { Readable, "m_KeepVertices", "m_KeepIndices" };

        /// <summary>Gives a mesh the flags of another.</summary>
        internal static void Copy(Mesh source, Mesh target)
        {
            if (ReferenceEquals(source, target)) { return; }
            MeshUtility.SetMeshCompression(target, MeshUtility.GetMeshCompression(source));
            using (var from = new SerializedObject(source))
            using (var to = new SerializedObject(target))
            {
                foreach (string name in copied) { Copy(from.FindProperty(name), to.FindProperty(name)); }
                to.ApplyModifiedPropertiesWithoutUndo();
            }
        }

        /// <summary>Unity has the data of every mesh in memory, and shows it to scripts if this flag is set.</summary>
        internal static void SetReadable(Mesh mesh, bool isReadable)
        {
            if (mesh.isReadable == isReadable) { return; }
            using (var serialized = new SerializedObject(mesh))
            {
                var flag = serialized.FindProperty(Readable);
                if (flag == null) { return; }
                flag.boolValue = isReadable;
                serialized.ApplyModifiedPropertiesWithoutUndo();
            }
        }

        private static void Copy(SerializedProperty from, SerializedProperty to)
        {
            if (from != null && to != null) { to.boolValue = from.boolValue; }
        }
#else
        internal static void Copy(Mesh source, Mesh target) { }

        internal static void SetReadable(Mesh mesh, bool isReadable) { }
#endif
    }
}
