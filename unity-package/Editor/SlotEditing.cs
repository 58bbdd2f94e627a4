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
            if (slot.Mesh == mesh) { return; }
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
        /// one in a file that is the holder's.
        /// </summary>
        /// <param name="result">What to write.</param>
        /// <param name="holder">Who will have it.</param>
        /// <param name="ours">A mesh that nobody else uses, or null.</param>
        /// <param name="action">The name of the undo step.</param>
        internal static void Write(JobResult result, Component holder, Mesh ours, string action)
        {
            if (ours != null && FreshMeshes.Contains(ours)) { result.Renew(ours); }
            else if (ours != null && IsInFileOf(holder, ours)) { Rewrite(result, ours, action); }
            else { WriteNew(result, holder, action); }
            FreshMeshes.Add(result.Mesh);
        }

        /// <summary>Replaces what a mesh of a file holds, so that what uses it follows.</summary>
        internal static void Rewrite(JobResult result, Mesh mesh, string action)
        {
            Undo.RegisterCompleteObjectUndo(mesh, action);
            result.Write(mesh);
            EditorUtility.SetDirty(mesh);
        }

        /// <summary>Takes away a mesh of ours that nobody uses any more: its scene or file would keep it for ever.</summary>
        internal static void Drop(Mesh ours, Component holder)
        {
            bool isInFile = EditorUtility.IsPersistent(ours);
            if (!isInFile && FreshMeshes.Contains(ours)) { Object.DestroyImmediate(ours); }
            else if (!isInFile || IsSubAssetOf(holder, ours)) { Undo.DestroyObjectImmediate(ours); }
        }

        /// <summary>Whether nobody can change the holder.</summary>
        internal static bool IsLocked(Component holder)
        {
            return WhyLocked(holder) != null;
        }

        /// <summary>Why nobody can change the holder, and what to do; null if one can.</summary>
        internal static string WhyLocked(Component holder)
        {
            if (!EditorUtility.IsPersistent(holder)) { return null; }
            string path = AssetDatabase.GetAssetPath(holder);
            if (!path.EndsWith(".prefab", StringComparison.OrdinalIgnoreCase))
            {
                return path + " was imported: give it the label Chamfer, or choose Assets > Chamfer Model Asset";
            }
            if (!AssetDatabase.CanOpenForEdit(holder))
            {
                return path + " cannot be changed: make a prefab variant of it in Assets";
            }
            var stage = PrefabStageUtility.GetCurrentPrefabStage();
            bool isOpen = stage != null && stage.assetPath == path;
            return isOpen ? path + " is open: select its objects there, or close it" : null;
        }

        /// <summary>Whether the holder is in a prefab's file, or in a prefab that is open.</summary>
        internal static bool IsInPrefab(Component holder)
        {
            return FilePath(holder).Length > 0 || StagePath(holder).Length > 0;
        }

        /// <summary>The file that the holder is in; empty for scenes and for prefabs that are open.</summary>
        internal static string FilePath(Component holder)
        {
            return AssetDatabase.GetAssetPath(holder);
        }

        /// <summary>The file of the prefab that is open and that the holder is in; empty otherwise.</summary>
        internal static string StagePath(Component holder)
        {
            if (EditorUtility.IsPersistent(holder)) { return ""; }
            var stage = PrefabStageUtility.GetPrefabStage(holder.gameObject);
            return stage != null ? stage.assetPath : "";
        }

        /// <summary>Whether a mesh has a file that the package made by itself.</summary>
        internal static bool IsManaged(Mesh mesh)
        {
            var record = ChamferRecords.Of(mesh);
            return record != null && record.isManaged;
        }

        /// <summary>
        /// The scene of a holder keeps its meshes by itself, but a prefab only what is in a file. Under a prefab that is
        /// open nothing is written, or Unity asks what to keep: its meshes get files when it is saved.
        /// </summary>
        private static void WriteNew(JobResult result, Component holder, string action)
        {
            result.Write();
            if (EditorUtility.IsPersistent(holder)) { AssetDatabase.AddObjectToAsset(result.Mesh, FilePath(holder)); }
            Undo.RegisterCreatedObjectUndo(result.Mesh, action);
        }

        private static bool IsInFileOf(Component holder, Mesh mesh)
        {
            return IsSubAssetOf(holder, mesh) || IsOfStage(StagePath(holder), mesh);
        }

        /// <summary>Whether a file was made for the prefab that is open, and nobody else has come to use it.</summary>
        private static bool IsOfStage(string stage, Mesh mesh)
        {
            var record = stage.Length > 0 ? ChamferRecords.Of(mesh) : null;
            bool isOwn = record != null && record.isManaged && record.owner == AssetDatabase.AssetPathToGUID(stage);
            return isOwn && !MeshUsers.IsInOtherFiles(AssetDatabase.GetAssetPath(mesh), stage);
        }

        private static bool IsSubAssetOf(Component holder, Mesh mesh)
        {
            string path = FilePath(holder);
            return path.Length > 0 && AssetDatabase.GetAssetPath(mesh) == path;
        }
    }
}
