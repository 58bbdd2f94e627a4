using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// What imported models depend on, by name, so that Unity imports them again when it changes, and never takes
    /// from a team's cache what was made otherwise. Every model names what could concern it, also one that is left
    /// alone.
    /// </summary>
    internal static class ImportDependency
    {
        private const string Prefix = "com.chamfer.unity/";
        private const string FolderPrefix = Prefix + "Folder/";
        private const string LabelPrefix = Prefix + "Label/";

        /// <summary>What chamfered models depend on: the settings for all, and the library.</summary>
        internal const string Settings = Prefix + "ProjectSettings";

        /// <summary>The rules that hold wherever a model lies.</summary>
        internal const string Rules = Prefix + "Rules";

        private static readonly Dictionary<string, string> labels = new Dictionary<string, string>();

        /// <summary>The GUIDs of all models: looking for them takes long in a large project. Null until then.</summary>
        private static HashSet<string> models;

        /// <summary>What a model depends on before it is known whether it is chamfered.</summary>
        internal static IEnumerable<string> Of(string path)
        {
            yield return Rules;
            yield return LabelPrefix + AssetDatabase.AssetPathToGUID(path);
            for (string folder = AssetNames.Folder(path); folder.Length > 0; folder = AssetNames.Folder(folder))
            {
                yield return FolderPrefix + folder;
            }
        }

        /// <summary>Tells Unity of the settings and labels as they are now.</summary>
        internal static void Register()
        {
            var project = ChamferProjectSettings.instance;
            Register(Settings, LibraryCheck.Version() + "\n" + SettingsText.Of(project.settings));
            // A folder whose last rule is gone must not keep what was told of it.
            AssetDatabase.UnregisterCustomDependencyPrefixFilter(FolderPrefix);
            Register(Rules, TextOf(project.rules.Where(rule => rule.Folder.Length == 0)));
            foreach (var rules in project.rules.Where(rule => rule.Folder.Length > 0).GroupBy(rule => rule.Folder))
            {
                Register(FolderPrefix + rules.Key, TextOf(rules));
            }
            // Unity remembers them longer than this process.
            AssetDatabase.UnregisterCustomDependencyPrefixFilter(LabelPrefix);
            labels.Clear();
            RegisterLabels();
        }

        /// <summary>A model that was imported.</summary>
        internal static void Note(string path)
        {
            if (models != null) { models.Add(AssetDatabase.AssetPathToGUID(path)); }
        }

        /// <summary>Tells Unity of the labels of models as they are now; returns those that have others than before.</summary>
        internal static List<string> RegisterLabels()
        {
            if (models == null) { models = new HashSet<string>(AssetDatabase.FindAssets("t:Model")); }
            var changed = new List<string>();
            foreach (string guid in models)
            {
                string path = AssetDatabase.GUIDToAssetPath(guid), before;
                if (string.IsNullOrEmpty(path)) { continue; }
                var ofInterest = ModelFacts.At(path).Labels.Where(IsOfInterest);
                string now = string.Join("\n", ofInterest.OrderBy(label => label, StringComparer.Ordinal));
                if (now == (labels.TryGetValue(guid, out before) ? before : "")) { continue; }
                labels[guid] = now;
                Register(LabelPrefix + guid, now);
                changed.Add(path);
            }
            return changed;
        }

        /// <summary>All that the settings say.</summary>
        internal static string Text(ChamferProjectSettings project)
        {
            return SettingsText.Of(project.settings) + "\n" + TextOf(project.rules);
        }

        [InitializeOnLoadMethod]
        private static void RegisterOnLoad()
        {
            // Worker processes are told by the editor that started them.
            if (!AssetDatabase.IsAssetImportWorkerProcess()) { Register(); }
        }

        private static bool IsOfInterest(string label)
        {
            var rules = ChamferProjectSettings.instance.rules;
            return ImportRule.IsLabel(label)
                || rules.Any(rule => string.Equals(rule.label, label, StringComparison.OrdinalIgnoreCase));
        }

        private static string TextOf(IEnumerable<ModelRule> rules)
        {
            return string.Join("\n", rules.Select(rule => rule.Text()));
        }

        private static void Register(string name, string text)
        {
            AssetDatabase.RegisterCustomDependency(name, Hash128.Compute(text));
        }
    }
}
