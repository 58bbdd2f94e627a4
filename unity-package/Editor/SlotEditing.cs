using System;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>Puts meshes into slots so that undo, prefab instances and prefab assets know of it.</summary>
    internal static class SlotEditing
    {
        internal static void Set(MeshSlot slot, Mesh mesh, string action)
        {
            Undo.RecordObject(slot.Holder, action);
            slot.Mesh = mesh;
            Changed(slot.Holder);
        }

        /// <summary>Marks an object that was recorded for undo and then changed.</summary>
        internal static void Changed(Object target)
        {
            EditorUtility.SetDirty(target);
            if (PrefabUtility.IsPartOfPrefabInstance(target))
            {
                PrefabUtility.RecordPrefabInstancePropertyModifications(target);
            }
        }

        /// <summary>
        /// Writes a result for a holder, into a mesh of ours if that may be reused. A new one gets a place to
        /// live: the scene of its holder keeps it by itself, but a prefab only what is in its own file.
        /// </summary>
        internal static void Write(JobResult result, Component holder, Mesh ours, string action)
        {
            string prefab = PrefabPath(holder);
            bool isInPrefab = ours != null && !string.IsNullOrEmpty(prefab) && AssetDatabase.GetAssetPath(ours) == prefab;
            if (isInPrefab) { Undo.RegisterCompleteObjectUndo(ours, action); }
            bool isReused = isInPrefab || ours != null && FreshMeshes.Contains(ours);
            result.Write(isReused ? ours : null);
            if (isReused) { return; }
            if (!string.IsNullOrEmpty(prefab)) { AssetDatabase.AddObjectToAsset(result.Mesh, prefab); }
            Undo.RegisterCreatedObjectUndo(result.Mesh, action);
            FreshMeshes.Add(result.Mesh);
        }

        /// <summary>Takes a mesh of ours out of the file of its holder's prefab, which would keep it for ever.</summary>
        internal static void DropFromPrefab(Mesh ours, Component holder)
        {
            string prefab = PrefabPath(holder);
            bool isInPrefab = !string.IsNullOrEmpty(prefab) && AssetDatabase.GetAssetPath(ours) == prefab;
            if (isInPrefab) { Undo.DestroyObjectImmediate(ours); }
        }

        /// <summary>Whether nobody can change the holder, because it was imported or is in an installed package.</summary>
        internal static bool IsLocked(Component holder)
        {
            if (!EditorUtility.IsPersistent(holder)) { return false; }
            bool isPrefab = AssetDatabase.GetAssetPath(holder).EndsWith(".prefab", StringComparison.OrdinalIgnoreCase);
            return !isPrefab || !AssetDatabase.CanOpenForEdit(holder);
        }

        private static string PrefabPath(Component holder)
        {
            if (EditorUtility.IsPersistent(holder)) { return AssetDatabase.GetAssetPath(holder); }
            var stage = PrefabStageUtility.GetPrefabStage(holder.gameObject);
            return stage != null ? stage.assetPath : null;
        }
    }
}
