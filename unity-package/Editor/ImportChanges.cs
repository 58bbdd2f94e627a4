using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Looks at what Unity has imported, moved and labelled: it does not import a model again for another place or
    /// another label by itself.
    /// </summary>
    internal sealed class ImportChanges : AssetPostprocessor
    {
        private static readonly HashSet<string> waiting = new HashSet<string>();
        private static readonly HashSet<string> told = new HashSet<string>();
        private static bool isComing;

        private static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] movedFrom)
        {
            for (int i = 0; i < moved.Length; i++)
            {
                if (IsModel(moved[i]) && HasChanged(moved[i], movedFrom[i])) { waiting.Add(moved[i]); }
            }
            foreach (string path in imported.Where(IsModel)) { ImportDependency.Note(path); }
            foreach (string path in imported.Where(IsDeaf)) { Tell(path); }
            if (PresetSync.Follow(imported)) { EditorApplication.delayCall += ModelImports.All; }
            Look();
        }

        [InitializeOnLoadMethod]
        internal static void Listen()
        {
            if (AssetDatabase.IsAssetImportWorkerProcess()) { return; }
            EditorApplication.projectChanged -= Look;
            EditorApplication.projectChanged += Look;
        }

        /// <summary>Not at once: nothing may be registered while Unity imports.</summary>
        private static void Look()
        {
            if (isComing) { return; }
            isComing = true;
            EditorApplication.delayCall += () =>
            {
                isComing = false;
                waiting.UnionWith(ImportDependency.RegisterLabels());
                var paths = waiting.ToList();
                waiting.Clear();
                ModelImports.Again(paths);
            };
        }

        private static bool HasChanged(string path, string from)
        {
            var labels = ModelFacts.At(path).Labels;
            return ModelImports.Concerning(ModelFacts.At(path, labels)) != ModelImports.Concerning(ModelFacts.At(from, labels));
        }

        private static bool IsModel(string path)
        {
            return AssetImporter.GetAtPath(path) is ModelImporter;
        }

        /// <summary>Whether a label asks an importer to chamfer that does not call this package.</summary>
        private static bool IsDeaf(string path)
        {
            bool isLabelled = ModelFacts.At(path).Labels.Any(ImportRule.IsLabel);
            return isLabelled && AssetDatabase.GetMainAssetTypeAtPath(path) == typeof(GameObject) && !IsModel(path)
                && !path.EndsWith(".prefab", System.StringComparison.OrdinalIgnoreCase);
        }

        private static void Tell(string path)
        {
            if (!told.Add(path)) { return; }
            Debug.LogWarning("The label Chamfer does nothing on " + path + ", because its importer does not let other "
                + "packages change what it makes: choose Assets > Chamfer Model Asset");
        }
    }
}
