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
        /// Writes a result for a holder, into a mesh of ours if that may be reused: one of the same undo step, or
        /// one in the file of the holder's prefab.
        /// </summary>
        internal static void Write(JobResult result, Component holder, Mesh ours, string action)
        {
            if (ours != null && FreshMeshes.Contains(ours)) { result.Write(ours); }
            else if (ours != null && IsInPrefabOf(holder, ours))
            {
                Undo.RegisterCompleteObjectUndo(ours, action);
                result.Write(ours);
            }
            else { WriteNew(result, holder, action); }
            FreshMeshes.Add(result.Mesh);
        }

        /// <summary>Takes a mesh of ours out of the file of its holder's prefab, which would keep it for ever.</summary>
        internal static void DropFromPrefab(Mesh ours, Component holder)
        {
            if (IsInPrefabOf(holder, ours)) { Undo.DestroyObjectImmediate(ours); }
        }

        /// <summary>Whether nobody can change the holder: it was imported, or is in an installed package.</summary>
        internal static bool IsLocked(Component holder)
        {
            if (!EditorUtility.IsPersistent(holder)) { return false; }
            bool isPrefab = AssetDatabase.GetAssetPath(holder).EndsWith(".prefab", StringComparison.OrdinalIgnoreCase);
            return !isPrefab || !AssetDatabase.CanOpenForEdit(holder);
        }

        /// <summary>Whether the holder is in a prefab's file, or in a prefab that is open.</summary>
        internal static bool IsInPrefab(Component holder)
        {
            return PrefabPath(holder).Length > 0;
        }

        /// <summary>The scene of a holder keeps its meshes by itself, but a prefab only what is in its own file.</summary>
        private static void WriteNew(JobResult result, Component holder, string action)
        {
            result.Write();
            string prefab = PrefabPath(holder);
            if (prefab.Length > 0) { AssetDatabase.AddObjectToAsset(result.Mesh, prefab); }
            Undo.RegisterCreatedObjectUndo(result.Mesh, action);
        }

        private static bool IsInPrefabOf(Component holder, Mesh mesh)
        {
            string prefab = PrefabPath(holder);
            return prefab.Length > 0 && AssetDatabase.GetAssetPath(mesh) == prefab;
        }

        /// <summary>Empty for holders in scenes.</summary>
        private static string PrefabPath(Component holder)
        {
            if (EditorUtility.IsPersistent(holder)) { return AssetDatabase.GetAssetPath(holder); }
            var stage = PrefabStageUtility.GetPrefabStage(holder.gameObject);
            return stage != null ? stage.assetPath : "";
        }
    }
}
