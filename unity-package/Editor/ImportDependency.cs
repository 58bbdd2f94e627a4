using System.Text;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Makes Unity import chamfered models again when Project Settings > Chamfer change, or the library does.
    /// </summary>
    internal static class ImportDependency
    {
        /// <summary>What chamfered models depend on.</summary>
        internal const string Name = "com.chamfer.unity/ProjectSettings";

        /// <summary>Tells Unity of the settings as they are now.</summary>
        internal static void Register()
        {
            AssetDatabase.RegisterCustomDependency(Name, Hash128.Compute(Text(ChamferProjectSettings.instance)));
        }

        /// <summary>Imports the models that the settings concern.</summary>
        internal static void ImportAgain()
        {
            Register();
            AssetDatabase.Refresh();
            // Those that were not chamfered before depend on nothing yet.
            foreach (var rule in ChamferProjectSettings.instance.folders) { ImportFolder(rule.Folder); }
        }

        [InitializeOnLoadMethod]
        private static void RegisterOnLoad()
        {
            // Worker processes are told by the editor that started them.
            if (!AssetDatabase.IsAssetImportWorkerProcess()) { Register(); }
        }

        private static void ImportFolder(string folder)
        {
            if (!AssetDatabase.IsValidFolder(folder)) { return; }
            foreach (string guid in AssetDatabase.FindAssets("t:Model", new[] { folder }))
            {
                AssetDatabase.ImportAsset(AssetDatabase.GUIDToAssetPath(guid), ImportAssetOptions.ForceUpdate);
            }
        }

        /// <summary>All that the settings say.</summary>
        internal static string Text(ChamferProjectSettings project)
        {
            var text = new StringBuilder(LibraryCheck.Version()).Append('\n');
            text.Append(SettingsText.Of(project.settings));
            foreach (var rule in project.folders)
            {
                text.Append('\n').Append(rule.Folder).Append(' ').Append(SettingsText.Of(rule.settings));
            }
            return text.ToString();
        }
    }
}
