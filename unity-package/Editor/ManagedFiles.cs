using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Files for chamfered meshes that belong to no prefab alone, made beside one.</summary>
    internal static class ManagedFiles
    {
        /// <summary>Makes one; returns its path.</summary>
        /// <param name="mesh">In no file yet.</param>
        /// <param name="source">What it was made of.</param>
        /// <param name="settings">How.</param>
        /// <param name="prefab">The file beside which it comes.</param>
        /// <param name="owner">The GUID of the prefab that alone may write it; empty if none may.</param>
        internal static string Make(Mesh mesh, Mesh source, ChamferSettings settings, string prefab, string owner)
        {
            string path = AssetNames.Free(AssetNames.Folder(prefab), source != null ? source : mesh);
            AssetDatabase.CreateAsset(mesh, path);
            // Undo would destroy the mesh, but not the file.
            Undo.ClearUndo(mesh);
            var record = ChamferRecord.Make(source, settings);
            record.isManaged = true;
            record.owner = owner;
            ChamferRecords.Write(mesh, record);
            AssetDatabase.SaveAssetIfDirty(mesh);
            return path;
        }
    }
}
