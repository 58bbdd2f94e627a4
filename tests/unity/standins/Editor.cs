// The editor, as far as the package uses it. What it is asked to do is recorded for tests to look at.
using System;
using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public static class MeshUtility
    {
        public static Mesh.MeshDataArray AcquireReadOnlyMeshData(Mesh mesh) { return Mesh.Snapshot(mesh); }
    }

    public static class Undo
    {
        public static readonly List<Object> recorded = new List<Object>();
        public static readonly List<Object> created = new List<Object>();
        public static int group, collapsed = -1;
        public static string groupName;
        public static void RecordObject(Object target, string name) { recorded.Add(target); }
        public static void RegisterCreatedObjectUndo(Object target, string name) { created.Add(target); }
        public static void IncrementCurrentGroup() { group++; }
        public static int GetCurrentGroup() { return group; }
        public static void SetCurrentGroupName(string name) { groupName = name; }
        public static void CollapseUndoOperations(int group) { collapsed = group; }
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
        public static string SaveFolderPanel(string title, string folder, string name) { return ""; }

        public static bool DisplayCancelableProgressBar(string title, string info, float progress)
        {
            barShown = true;
            return onProgress(progress);
        }
    }

    public static class PrefabUtility
    {
        public static readonly HashSet<Object> instances = new HashSet<Object>();
        public static readonly HashSet<Object> models = new HashSet<Object>();
        public static readonly List<Object> modified = new List<Object>();
        public static bool IsPartOfPrefabInstance(Object target) { return instances.Contains(target); }
        public static bool IsPartOfModelPrefab(Object target) { return models.Contains(target); }
        public static void RecordPrefabInstancePropertyModifications(Object target) { modified.Add(target); }
    }

    public struct GUID { public string path; }

    public static class AssetDatabase
    {
        public static readonly Dictionary<Object, string> paths = new Dictionary<Object, string>();
        public static readonly Dictionary<string, string[]> labels = new Dictionary<string, string[]>();
        public static bool Contains(Object target) { return paths.ContainsKey(target); }
        public static string GetAssetPath(Object target) { return Contains(target) ? paths[target] : ""; }
        public static void AddObjectToAsset(Object target, string path) { paths[target] = path; }
        public static void CreateAsset(Object target, string path) { paths[target] = path; }
        public static string GenerateUniqueAssetPath(string path) { return path; }
        public static void SaveAssets() { }
        public static bool IsValidFolder(string path) { return path.StartsWith("Assets"); }
        public static GUID GUIDFromAssetPath(string path) { return new GUID { path = path }; }
        public static string GUIDToAssetPath(string guid) { return guid; }
        public static string[] GetLabels(GUID guid) { return labels.ContainsKey(guid.path) ? labels[guid.path] : new string[0]; }

        public static string[] FindAssets(string filter, string[] folders)
        {
            var found = new List<string>();
            foreach (var entry in paths)
            {
                if (entry.Key is GameObject && entry.Value.StartsWith(folders[0] + "/")) { found.Add(entry.Value); }
            }
            return found.ToArray();
        }

        public static T LoadAssetAtPath<T>(string path) where T : Object
        {
            foreach (var entry in paths) { if (entry.Key is T && entry.Value == path) { return (T)entry.Key; } }
            return null;
        }
    }

    public static class FileUtil { public static string GetProjectRelativePath(string path) { return path; } }
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
