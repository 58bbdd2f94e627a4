using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;

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
        /// Gives a new mesh a place to live: the scene of its holder keeps it by itself, but a prefab only what
        /// is in its own file.
        /// </summary>
        internal static void Keep(Mesh mesh, Component holder, string action)
        {
            string prefab = PrefabPath(holder);
            if (!string.IsNullOrEmpty(prefab)) { AssetDatabase.AddObjectToAsset(mesh, prefab); }
            Undo.RegisterCreatedObjectUndo(mesh, action);
        }

        /// <summary>Whether the holder is in the file of an imported model, which nobody can change.</summary>
        internal static bool IsImported(Component holder)
        {
            return EditorUtility.IsPersistent(holder) && PrefabUtility.IsPartOfModelPrefab(holder);
        }

        private static string PrefabPath(Component holder)
        {
            if (EditorUtility.IsPersistent(holder)) { return AssetDatabase.GetAssetPath(holder); }
            var stage = PrefabStageUtility.GetPrefabStage(holder.gameObject);
            return stage != null ? stage.assetPath : null;
        }
    }
}
