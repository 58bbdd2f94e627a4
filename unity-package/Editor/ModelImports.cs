using System.Collections.Generic;
using System.Linq;
using UnityEditor;

namespace ChamferEditor
{
    /// <summary>Imports models again whose outcome has changed.</summary>
    internal static class ModelImports
    {
        /// <summary>Imports all that the settings concern, or did when they were imported; each once.</summary>
        internal static void All()
        {
            ImportDependency.Register();
            var paths = AssetDatabase.FindAssets("t:Model").Select(guid => AssetDatabase.GUIDToAssetPath(guid));
            Again(paths.Where(path => IsConcerned(path) || AssetDatabase.LoadAssetAtPath<ChamferRecord>(path) != null));
        }

        /// <summary>Imports models, each once, and tells Unity of all at the same time.</summary>
        internal static void Again(IEnumerable<string> paths)
        {
            var distinct = paths.Distinct().OrderBy(path => path, System.StringComparer.Ordinal).ToList();
            if (distinct.Count == 0) { return; }
            AssetDatabase.StartAssetEditing();
            try
            {
                foreach (string path in distinct) { AssetDatabase.ImportAsset(path, ImportAssetOptions.ForceUpdate); }
            }
            finally { AssetDatabase.StopAssetEditing(); }
        }

        /// <summary>The rules and labels that can concern a model, as text.</summary>
        internal static string Concerning(ModelFacts model)
        {
            var rules = ChamferProjectSettings.instance.rules.Where(rule => rule.CanConcern(model)).Select(rule => rule.Text());
            return string.Join("\n", model.Labels.Where(ImportRule.IsLabel).Concat(rules));
        }

        private static bool IsConcerned(string path)
        {
            return Concerning(ModelFacts.At(path)).Length > 0;
        }
    }
}
