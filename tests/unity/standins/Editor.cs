// The editor, as far as the package uses it. What it is asked to do is recorded for tests to look at.
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public static class MeshUtility
    {
        public static Mesh.MeshDataArray AcquireReadOnlyMeshData(Mesh mesh) { return Mesh.Snapshot(mesh); }
    }

    public static class EditorUtility
    {
        public static readonly HashSet<Object> persistent = new HashSet<Object>();
        public static readonly HashSet<Object> dirty = new HashSet<Object>();
        public static Func<float, bool> onProgress = share => false;
        public static bool barShown;
        public static bool IsPersistent(Object target) { return persistent.Contains(target); }
        public static void SetDirty(Object target) { dirty.Add(target); }
        public static void ClearProgressBar() { barShown = false; }
        /// The folder that the user chooses; none if the dialogue is cancelled.
        public static string chosen = "";
        public static string SaveFolderPanel(string title, string folder, string name) { return chosen; }

        public static bool DisplayCancelableProgressBar(string title, string info, float progress)
        {
            barShown = true;
            return onProgress(progress);
        }
    }

    public static class PrefabUtility
    {
        public static readonly HashSet<Object> instances = new HashSet<Object>();
        public static readonly List<Object> modified = new List<Object>();
        public static bool IsPartOfPrefabInstance(Object target) { return instances.Contains(target); }
        public static void RecordPrefabInstancePropertyModifications(Object target) { modified.Add(target); }
    }

    public struct GUID { public string path; }

    public static class AssetDatabase
    {
        public static readonly Dictionary<Object, string> paths = new Dictionary<Object, string>();
        public static readonly Dictionary<string, string[]> labels = new Dictionary<string, string[]>();
        public static readonly Dictionary<string, Hash128> dependencies = new Dictionary<string, Hash128>();
        public static readonly List<string> imported = new List<string>();
        public static bool Contains(Object target) { return paths.ContainsKey(target); }
        public static string GetAssetPath(Object target) { return Contains(target) ? paths[target] : ""; }
        public static void AddObjectToAsset(Object target, string path) { paths[target] = path; }
        public static void CreateAsset(Object target, string path) { paths[target] = path; }
        public static string GenerateUniqueAssetPath(string path) { return path; }
        public static void SaveAssets() { }
        public static bool CanOpenForEdit(Object target) { return !paths[target].StartsWith("Packages/"); }
        public static bool IsValidFolder(string path) { return path.StartsWith("Assets"); }
        public static GUID GUIDFromAssetPath(string path) { return new GUID { path = path }; }
        public static string GUIDToAssetPath(string guid) { return guid; }
        public static string[] GetLabels(GUID guid) { return labels.ContainsKey(guid.path) ? labels[guid.path] : new string[0]; }

        public static string[] GetLabels(Object target) { return GetLabels(GUIDFromAssetPath(paths[target])); }
        public static void SetLabels(Object target, string[] values) { labels[paths[target]] = values; }
        public static void ImportAsset(string path, ImportAssetOptions options) { imported.Add(path); }
        public static bool IsAssetImportWorkerProcess() { return false; }
        public static void RegisterCustomDependency(string name, Hash128 hash) { dependencies[name] = hash; }
        public static void Refresh() { imported.Add("(what depends on changes)"); }
        public static Object LoadMainAssetAtPath(string path) { return LoadAssetAtPath<GameObject>(path); }

        /// The kinds that are used: t:Model, t:Prefab, t:Mesh.
        public static string[] FindAssets(string filter, string[] folders)
        {
            return paths.Where(entry => IsOfKind(entry.Key, entry.Value, filter) && entry.Value.StartsWith(folders[0] + "/"))
                .Select(entry => entry.Value).ToArray();
        }

        private static bool IsOfKind(Object asset, string path, string filter)
        {
            if (filter == "t:Mesh") { return asset is Mesh; }
            return asset is GameObject && path.EndsWith(".prefab") == (filter == "t:Prefab");
        }

        public static Object[] LoadAllAssetsAtPath(string path)
        {
            return paths.Where(entry => entry.Value == path).Select(entry => entry.Key).ToArray();
        }

        public static T LoadAssetAtPath<T>(string path) where T : Object
        {
            return LoadAllAssetsAtPath(path).OfType<T>().FirstOrDefault();
        }
    }

    public enum ImportAssetOptions { Default = 0, ForceUpdate = 1 }

    [AttributeUsage(AttributeTargets.Method)]
    public class InitializeOnLoadMethodAttribute : Attribute { }

    public static class Selection { public static Object[] objects = new Object[0]; }
    public static class EditorApplication { public static int exitCode = -1; public static void Exit(int code) { exitCode = code; } }
    public class MenuCommand { public Object context; }

    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public class MenuItem : Attribute
    {
        public readonly string path;
        public readonly bool isValidator;
        public MenuItem(string path, bool isValidator) { this.path = path; this.isValidator = isValidator; }
        public MenuItem(string path, bool isValidator, int priority) : this(path, isValidator) { }
    }

    public class AssetPostprocessor
    {
        public string assetPath { get; set; }
        public AssetImporters.AssetImportContext context { get; set; }
        public virtual uint GetVersion() { return 0; }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public class FilePathAttribute : Attribute
    {
        public enum Location { PreferencesFolder, ProjectFolder }
        public FilePathAttribute(string path, Location location) { }
    }

    public class ScriptableSingleton<T> : ScriptableObject where T : ScriptableObject, new()
    {
        private static T made;
        public static T instance { get { return made ?? (made = new T()); } }
        protected void Save(bool asText) { }
    }
}

namespace UnityEditor.AssetImporters
{
    public class AssetImportContext
    {
        public readonly List<string> warnings = new List<string>();
        public readonly List<string> dependencies = new List<string>();
        public void DependsOnCustomDependency(string dependency) { dependencies.Add(dependency); }
        public void LogImportWarning(string message, Object target = null) { warnings.Add(message); }
    }
}

namespace UnityEditor.SceneManagement
{
    public class PrefabStage { public string assetPath { get; set; } }

    public static class PrefabStageUtility
    {
        public static PrefabStage stage;
        public static PrefabStage GetPrefabStage(GameObject target) { return stage; }
    }
}
