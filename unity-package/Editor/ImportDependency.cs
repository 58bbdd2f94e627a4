using System.Globalization;
using System.Text;
using Chamfer;
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

        private static string Text(ChamferProjectSettings project)
        {
            var text = new StringBuilder(LibraryCheck.Version()).Append('\n');
            Append(text, project.settings);
            foreach (var rule in project.folders)
            {
                text.Append('\n').Append(rule.Folder).Append(' ');
                Append(text, rule.settings);
            }
            return text.ToString();
        }

        private static void Append(StringBuilder text, ChamferSettings settings)
        {
            text.Append(settings.width.ToString("R", CultureInfo.InvariantCulture)).Append(' ').Append(settings.unit);
            text.Append(' ').Append(settings.verify).Append(' ').Append(settings.submeshMode).Append(' ');
            text.Append(settings.submesh);
        }
    }
}
