// The asset database: which object is in which file, and what happened to files.
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public struct GUID
    {
        public string path;
        public override string ToString() { return path; }
    }

    public enum ImportAssetOptions { Default = 0, ForceUpdate = 1 }

    public static class AssetDatabase
    {
        public static readonly Dictionary<Object, string> paths = new Dictionary<Object, string>();
        public static readonly Dictionary<string, string[]> labels = new Dictionary<string, string[]>();
        public static readonly Dictionary<string, Hash128> dependencies = new Dictionary<string, Hash128>();
        public static readonly List<string> imported = new List<string>();
        /// Which files were written, each by itself.
        public static readonly List<string> saved = new List<string>();
        public static int savedAll, editing;
        /// Whether a prefab was written under its open stage, so that Unity asks whether to keep or discard.
        public static bool asked;
        public static bool isWorker;
        /// Fails when a file is made, as a full disk does.
        public static Func<string, bool> fails = path => false;

        public static bool Contains(Object target) { return !ReferenceEquals(target, null) && target != null && (paths.ContainsKey(target) || IsInPrefab(target)); }

        /// What is added to an object of a prefab is in the prefab's file.
        private static bool IsInPrefab(Object target)
        {
            var component = target as Component;
            return !ReferenceEquals(component, null) && paths.ContainsKey(component.transform.root.gameObject);
        }

        public static bool IsSubAsset(Object target) { return Contains(target) && !ReferenceEquals(LoadMainAssetAtPath(paths[target]), target); }
        public static bool IsMainAsset(Object target) { return Contains(target) && !IsSubAsset(target); }
        
        public static string GetAssetPath(Object target)
        {
            if (!Contains(target)) { return ""; }
            return paths.ContainsKey(target) ? paths[target] : paths[((Component)target).transform.root.gameObject];
        }


        public static void AddObjectToAsset(Object target, string path)
        {
            if (fails(path)) { throw new UnityException("cannot write " + path); }
            NoteStage(path);
            paths[target] = path;
        }

        public static void AddObjectToAsset(Object target, Object asset) { AddObjectToAsset(target, paths[asset]); }

        /// What was in the file is gone.
        public static void CreateAsset(Object target, string path)
        {
            if (fails(path)) { throw new UnityException("cannot write " + path); }
            if (System.IO.Path.GetFileName(path).IndexOfAny("<>:\"\\|?*".ToCharArray()) >= 0) { throw new UnityException("no name for a file: " + path); }
            foreach (var before in LoadAllAssetsAtPath(path)) { before.destroyed = true; paths.Remove(before); }
            paths[target] = path;
            saved.Add(path);
        }

        public static string CreateFolder(string parent, string name) { return parent + "/" + name; }

        /// A file, or all of a folder.
        public static bool DeleteAsset(string path)
        {
            var all = paths.Where(entry => entry.Value == path || entry.Value.StartsWith(path + "/")).Select(entry => entry.Key).ToArray();
            foreach (var asset in all) { asset.destroyed = true; paths.Remove(asset); }
            return all.Length > 0;
        }

        public static string GenerateUniqueAssetPath(string path)
        {
            string folder = path.Substring(0, path.LastIndexOf('/') + 1), name = path.Substring(folder.Length);
            int dot = name.LastIndexOf('.');
            string free = path;
            for (int n = 1; LoadAllAssetsAtPath(free).Length > 0; n++) { free = folder + name.Substring(0, dot) + " " + n + name.Substring(dot); }
            return free;
        }

        public static void SaveAssets() { savedAll++; }

        public static void SaveAssetIfDirty(Object target)
        {
            NoteStage(paths[target]);
            saved.Add(paths[target]);
        }

        /// Prefabs that are not loaded, and the files that they use.
        public static readonly Dictionary<string, string[]> unloaded = new Dictionary<string, string[]>();

        /// The files that a prefab's meshes are in.
        public static string[] GetDependencies(string path, bool recursive)
        {
            if (unloaded.ContainsKey(path)) { return unloaded[path]; }
            return LoadAllAssetsAtPath(path).OfType<MeshFilter>().Select(filter => GetAssetPath(filter.sharedMesh)).Where(file => file.Length > 0).Distinct().ToArray();
        }

        private static void NoteStage(string path)
        {
            var stage = SceneManagement.PrefabStageUtility.GetCurrentPrefabStage();
            asked |= stage != null && stage.assetPath == path;
        }

        public static bool CanOpenForEdit(Object target) { return !GetAssetPath(target).StartsWith("Packages/"); }
        public static bool IsValidFolder(string path) { return path.StartsWith("Assets") && !System.IO.Path.HasExtension(path); }
        public static GUID GUIDFromAssetPath(string path) { return new GUID { path = path }; }
        public static string AssetPathToGUID(string path) { return path; }
        public static string GUIDToAssetPath(string guid) { return guid; }
        public static string[] GetLabels(GUID guid) { return labels.ContainsKey(guid.path) ? labels[guid.path] : new string[0]; }
        public static string[] GetLabels(Object target) { return GetLabels(GUIDFromAssetPath(paths[target])); }
        public static void SetLabels(Object target, string[] values) { labels[paths[target]] = values; }
        public static void StartAssetEditing() { editing++; }
        public static void StopAssetEditing() { editing--; }
        public static bool IsAssetImportWorkerProcess() { return isWorker; }

        public static void ImportAsset(string path, ImportAssetOptions options)
        {
            imported.Add((editing > 0 ? "together: " : "") + path);
            Project.Import(path);
        }

        public static void RegisterCustomDependency(string name, Hash128 hash)
        {
            if (Project.isImporting) { throw new UnityException("not while something is imported"); }
            dependencies[name] = hash;
        }

        public static uint UnregisterCustomDependencyPrefixFilter(string prefix)
        {
            var names = dependencies.Keys.Where(name => name.StartsWith(prefix)).ToList();
            names.ForEach(name => dependencies.Remove(name));
            return (uint)names.Count;
        }

        public static void Refresh() { Project.Refresh(); }
        public static Object LoadMainAssetAtPath(string path)
        {
            var all = LoadAllAssetsAtPath(path);
            return all.FirstOrDefault(asset => asset is GameObject) ?? all.FirstOrDefault(asset => asset is Mesh) ?? all.FirstOrDefault();
        }

        public static Type GetMainAssetTypeAtPath(string path) { var main = LoadMainAssetAtPath(path); return main != null ? main.GetType() : null; }

        /// The kinds that are used: t:Model, t:Prefab, t:Mesh, and l:Label.
        public static string[] FindAssets(string filter, string[] folders = null)
        {
            if (filter.StartsWith("l:")) { return labels.Where(entry => entry.Value.Any(label => label.ToLower().Contains(filter.Substring(2).ToLower()))).Select(entry => entry.Key).ToArray(); }
            return paths.Where(entry => entry.Key != null && IsOfKind(entry.Key, entry.Value, filter) && (folders == null || entry.Value.StartsWith(folders[0] + "/")))
                .Select(entry => entry.Value).Concat(Project.Models(filter, folders)).Concat(filter == "t:Prefab" && folders == null ? unloaded.Keys.ToArray() : new string[0]).Distinct().ToArray();
        }

        private static bool IsOfKind(Object asset, string path, string filter)
        {
            if (filter == "t:Mesh") { return asset is Mesh; }
            if (filter == "t:Scene") { return false; }
            return asset is GameObject && path.EndsWith(".prefab") == (filter == "t:Prefab");
        }

        public static Object[] LoadAllAssetsAtPath(string path)
        {
            return paths.Where(entry => entry.Value == path && entry.Key != null).Select(entry => entry.Key).ToArray();
        }

        public static T LoadAssetAtPath<T>(string path) where T : Object
        {
            return LoadAllAssetsAtPath(path).OfType<T>().FirstOrDefault();
        }
    }

    public class AssetImporter : Object
    {
        public string assetPath { get; set; }
        public static AssetImporter GetAtPath(string path) { return Project.ImporterOf(path); }
    }

    public class ModelImporter : AssetImporter { public bool keepQuads { get; set; } }

    public class AssetPostprocessor
    {
        public string assetPath { get; set; }
        public AssetImporter assetImporter { get; set; }
        public AssetImporters.AssetImportContext context { get; set; }
        public virtual uint GetVersion() { return 0; }
        public virtual int GetPostprocessOrder() { return 0; }
    }

    /// Model files, and importing them with the package's postprocessors.
    public static class Project
    {
        private sealed class File
        {
            public Func<GameObject> Build;
            public AssetImporter Importer;
            public Dictionary<string, Hash128> Dependencies = new Dictionary<string, Hash128>();
        }

        private static readonly Dictionary<string, File> files = new Dictionary<string, File>();
        public static bool isImporting;
        public static AssetImporters.AssetImportContext lastImport;
        /// The postprocessors of the package: their types.
        public static readonly List<Type> postprocessors = new List<Type>();

        public static void AddModel(string path, Func<GameObject> build, AssetImporter importer = null)
        {
            importer = importer ?? new ModelImporter();
            importer.assetPath = path;
            files[path] = new File { Build = build, Importer = importer };
            AssetDatabase.ImportAsset(path, ImportAssetOptions.Default);
        }

        public static void Move(string from, string to)
        {
            files[to] = files[from];
            files.Remove(from);
            files[to].Importer.assetPath = to;
            foreach (var asset in AssetDatabase.LoadAllAssetsAtPath(from)) { AssetDatabase.paths[asset] = to; }
            if (AssetDatabase.labels.ContainsKey(from)) { AssetDatabase.labels[to] = AssetDatabase.labels[from]; AssetDatabase.labels.Remove(from); }
            Tell(new string[0], new[] { to }, new[] { from });
        }

        /// As if it was imported that moment.
        public static void TellImported(string path) { Tell(new[] { path }, new string[0], new string[0]); }
        public static Object Loaded(string path) { return AssetDatabase.LoadMainAssetAtPath(path); }
        public static AssetImporter ImporterOf(string path) { return files.ContainsKey(path) ? files[path].Importer : null; }

        internal static IEnumerable<string> Models(string filter, string[] folders)
        {
            if (filter != "t:Model") { return new string[0]; }
            return files.Where(file => file.Value.Importer is ModelImporter).Select(file => file.Key)
                .Where(path => folders == null || path.StartsWith(folders[0] + "/"));
        }

        internal static void Refresh()
        {
            foreach (string path in files.Keys.ToList())
            {
                if (files[path].Dependencies.Any(one => !Current(one.Key).Equals(one.Value))) { AssetDatabase.ImportAsset(path, ImportAssetOptions.Default); }
            }
        }

        private static Hash128 Current(string name)
        {
            Hash128 hash;
            return AssetDatabase.dependencies.TryGetValue(name, out hash) ? hash : new Hash128();
        }

        internal static void Import(string path)
        {
            if (!files.ContainsKey(path)) { return; }
            var file = files[path];
            AssetDatabase.DeleteAsset(path);
            var root = file.Build();
            lastImport = new AssetImporters.AssetImportContext { assetPath = path };
            isImporting = true;
            try { Process(file, path, root); }
            finally { isImporting = false; }
            file.Dependencies = lastImport.dependencies.Distinct().ToDictionary(name => name, Current);
            Keep(path, root);
            Tell(new[] { path }, new string[0], new string[0]);
        }

        private static void Process(File file, string path, GameObject root)
        {
            if (!(file.Importer is ModelImporter)) { return; }
            foreach (var type in postprocessors)
            {
                var hook = type.GetMethod("OnPostprocessModel", System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic);
                if (hook == null) { continue; }
                var processor = (AssetPostprocessor)Activator.CreateInstance(type, true);
                processor.assetPath = path;
                processor.assetImporter = file.Importer;
                processor.context = lastImport;
                hook.Invoke(processor, new object[] { root });
            }
        }

        private static void Keep(string path, GameObject root)
        {
            AssetDatabase.paths[root] = path;
            foreach (var added in lastImport.objects) { AssetDatabase.paths[added] = path; }
            foreach (var component in root.GetComponentsInChildren<Component>(true))
            {
                AssetDatabase.paths[component] = path;
                var filter = component as MeshFilter;
                if (filter != null && filter.sharedMesh != null) { AssetDatabase.paths[filter.sharedMesh] = path; }
            }
        }

        private static void Tell(string[] imported, string[] moved, string[] from)
        {
            foreach (var type in postprocessors)
            {
                var hook = type.GetMethod("OnPostprocessAllAssets", System.Reflection.BindingFlags.Static | System.Reflection.BindingFlags.NonPublic);
                if (hook != null) { hook.Invoke(null, new object[] { imported, new string[0], moved, from }); }
            }
        }
    }
}

namespace UnityEditor.AssetImporters
{
    public class ScriptedImporter : AssetImporter { }

    public class AssetImportContext
    {
        public string assetPath { get; set; }
        public readonly List<string> warnings = new List<string>();
        public readonly List<string> dependencies = new List<string>();
        public readonly List<Object> objects = new List<Object>();
        public void DependsOnCustomDependency(string dependency) { dependencies.Add(dependency); }
        public void LogImportWarning(string message, Object target = null) { warnings.Add(message); }
        public void AddObjectToAsset(string identifier, Object target) { objects.Add(target); }
    }
}

namespace UnityEngine
{
    public class UnityException : Exception { public UnityException(string message) : base(message) { } }
}
