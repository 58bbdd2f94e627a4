using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Objects with the same source and settings share one mesh, as a hundred crates do.</summary>
    internal static class SharedMeshes
    {
        /// <summary>What somebody else made already of a source with a key, if a holder can have it too; or null.</summary>
        internal static JobResult Find(LoadedModifiers loaded, Mesh source, string key, Component holder, ChamferModifier but)
        {
            if (key == MeshKeys.Unknown) { return null; }
            foreach (var place in loaded.Places)
            {
                var entry = place.Entry;
                bool isWanted = entry.key == key && entry.original == source && place.Modifier != but;
                bool isThere = entry.chamfered != null && entry.holder != null;
                if (isWanted && isThere && CanShare(entry, holder)) { return new JobResult(entry); }
            }
            return null;
        }

        /// <summary>
        /// A scene, and an open prefab, have meshes of their own, and so has a prefab's file. What the user has saved
        /// is the user's.
        /// </summary>
        private static bool CanShare(ChamferedMesh entry, Component holder)
        {
            bool isInFile = EditorUtility.IsPersistent(holder);
            if (isInFile != EditorUtility.IsPersistent(entry.holder)) { return false; }
            string path = AssetDatabase.GetAssetPath(entry.chamfered);
            if (isInFile) { return path == AssetDatabase.GetAssetPath(holder); }
            if (holder.gameObject.scene != entry.holder.gameObject.scene) { return false; }
            return path.Length == 0 || SlotEditing.IsManaged(entry.chamfered);
        }
    }
}
