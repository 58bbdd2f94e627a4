using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Gives the meshes of an open prefab files of their own when it is saved, because it would lose what is in none.
    /// </summary>
    internal static class StageMeshes
    {
        [InitializeOnLoadMethod]
        internal static void Listen()
        {
            PrefabStage.prefabSaving -= Save;
            PrefabStage.prefabSaving += Save;
        }

        private static void Save(GameObject root)
        {
            var stage = PrefabStageUtility.GetPrefabStage(root);
            if (stage == null) { return; }
            var done = new HashSet<Mesh>();
            foreach (var modifier in root.GetComponentsInChildren<ChamferModifier>(true))
            {
                foreach (var entry in modifier.meshes.Where(entry => entry.chamfered != null && done.Add(entry.chamfered)))
                {
                    Save(entry, stage.assetPath);
                }
            }
        }

        private static void Save(ChamferedMesh entry, string prefab)
        {
            if (!AssetDatabase.Contains(entry.chamfered))
            {
                string owner = AssetDatabase.AssetPathToGUID(prefab);
                ManagedFiles.Make(entry.chamfered, entry.original, entry.settings, prefab, owner);
            }
            else if (AssetDatabase.GetAssetPath(entry.chamfered) != prefab) { AssetDatabase.SaveAssetIfDirty(entry.chamfered); }
        }
    }
}
