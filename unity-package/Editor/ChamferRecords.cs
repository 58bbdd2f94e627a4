using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What files know of their chamfered meshes.</summary>
    internal static class ChamferRecords
    {
        /// <summary>The record in a mesh's file; null where there is none.</summary>
        internal static ChamferRecord Of(Mesh mesh)
        {
            string path = AssetDatabase.GetAssetPath(mesh);
            return path.Length > 0 ? AssetDatabase.LoadAssetAtPath<ChamferRecord>(path) : null;
        }

        /// <summary>Whether a mesh was saved as a result, or chamfered when its model was imported.</summary>
        internal static bool IsResult(Mesh mesh)
        {
            return Of(mesh) != null;
        }

        /// <summary>Puts a record into the file of a mesh; it replaces that of an earlier time.</summary>
        internal static void Write(Mesh chamfered, ChamferRecord record)
        {
            var earlier = Of(chamfered);
            if (earlier != null) { Object.DestroyImmediate(earlier, true); }
            AssetDatabase.AddObjectToAsset(record, AssetDatabase.GetAssetPath(chamfered));
        }
    }
}
