// Prefabs, their instances and variants, and the stage in which one is open.
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public static class PrefabUtility
    {
        public static readonly HashSet<Object> instances = new HashSet<Object>();
        public static readonly List<Object> modified = new List<Object>();
        public static bool IsPartOfPrefabInstance(Object target) { return instances.Contains(target) || GetCorrespondingObjectFromSource(target) != null; }

        public static void RecordPrefabInstancePropertyModifications(Object target)
        {
            modified.Add(target);
            if (target is Component) { ((Component)target).recorded = true; }
        }

        public static T GetCorrespondingObjectFromSource<T>(T target) where T : Object
        {
            object source = target is Component ? ((Component)(object)target).source : (object)((GameObject)(object)target).source;
            return (T)source;
        }

        /// An object of the scene that follows a prefab.
        public static Object InstantiatePrefab(Object prefab)
        {
            return ((GameObject)prefab).Duplicate((from, to) => { to.source = from; to.recorded = false; to.gameObject.source = from.gameObject; if (to is MeshFilter) { ((MeshFilter)to).Merge(); } });
        }

        /// What is an instance of another prefab becomes a variant of it.
        public static GameObject SaveAsPrefabAsset(GameObject root, string path)
        {
            if (AssetDatabase.fails(path)) { throw new UnityException("cannot write " + path); }
            var saved = root.Duplicate((from, to) => { to.source = from.source; to.gameObject.source = from.gameObject.source; });
            AssetDatabase.paths[saved] = path;
            foreach (var component in saved.GetComponentsInChildren<Component>(true)) { AssetDatabase.paths[component] = path; }
            AssetDatabase.saved.Add(path);
            return saved;
        }
    }
}

namespace UnityEditor.SceneManagement
{
    public class PrefabStage
    {
        public static event Action<GameObject> prefabSaving;
        public string assetPath { get; set; }
        public GameObject prefabContentsRoot { get; set; }

        /// What Unity does when the user saves, or by itself after a change.
        public void Save()
        {
            if (prefabSaving != null) { prefabSaving(prefabContentsRoot); }
            foreach (var component in prefabContentsRoot.GetComponentsInChildren<MeshFilter>(true))
            {
                // What is in no file is lost.
                if (component.sharedMesh != null && !AssetDatabase.Contains(component.sharedMesh)) { component.sharedMesh = null; }
            }
        }
    }

    public static class PrefabStageUtility
    {
        private static PrefabStage stage;
        public static PrefabStage GetCurrentPrefabStage() { return stage; }

        public static PrefabStage GetPrefabStage(GameObject item)
        {
            return stage != null && item.transform.root == stage.prefabContentsRoot.transform ? stage : null;
        }

        /// Opens a prefab: its contents are a copy of what the file holds.
        public static PrefabStage Open(GameObject prefab)
        {
            var contents = prefab.Duplicate();
            contents.scene = new UnityEngine.SceneManagement.Scene { name = "stage of " + prefab.name };
            return stage = new PrefabStage { assetPath = AssetDatabase.GetAssetPath(prefab), prefabContentsRoot = contents };
        }

        public static void Close() { stage = null; }
    }
}
