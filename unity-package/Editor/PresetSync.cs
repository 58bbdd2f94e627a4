using System.Linq;
using Chamfer;
using UnityEditor;

namespace ChamferEditor
{
    /// <summary>
    /// Keeps the values of presets in the project settings: whoever imports reads them there, because the preset itself
    /// may not be imported yet.
    /// </summary>
    internal static class PresetSync
    {
        /// <summary>Copies what presets say now.</summary>
        internal static void Copy(ChamferProjectSettings project)
        {
            if (project.preset != null) { project.settings = project.preset.settings.Copy(); }
            for (int i = 0; i < project.rules.Count; i++)
            {
                var rule = project.rules[i];
                if (rule.preset == null) { continue; }
                rule.settings = rule.preset.settings.Copy();
                project.rules[i] = rule;
            }
        }

        /// <summary>Looks at assets that were imported: where one is a preset, the settings follow.</summary>
        internal static bool Follow(string[] imported)
        {
            if (!imported.Any(path => AssetDatabase.GetMainAssetTypeAtPath(path) == typeof(ChamferPreset))) { return false; }
            var project = ChamferProjectSettings.instance;
            string before = ImportDependency.Text(project);
            Copy(project);
            if (ImportDependency.Text(project) == before) { return false; }
            project.Write();
            return true;
        }
    }
}
