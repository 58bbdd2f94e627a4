using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The page Project Settings > Chamfer.</summary>
    internal static class ChamferSettingsPage
    {
        [SettingsProvider]
        private static SettingsProvider Create()
        {
            return new SettingsProvider("Project/Chamfer", SettingsScope.Project, new[] { "chamfer", "bevel", "mesh" })
            {
                guiHandler = search => Draw()
            };
        }

        private static void Draw()
        {
            var settings = ChamferProjectSettings.instance;
            var serialized = new SerializedObject(settings);
            EditorGUILayout.PropertyField(serialized.FindProperty("preset"));
            EditorGUILayout.PropertyField(serialized.FindProperty("settings"), true);
            EditorGUILayout.PropertyField(serialized.FindProperty("rules"), true);
            if (serialized.ApplyModifiedProperties() | FolderDrop.Draw(settings)) { settings.Write(); }
            if (GUILayout.Button("Try Rules")) { Try(); }
            EditorGUILayout.HelpBox("Models that are imported already follow when you press this.", MessageType.Info);
            if (GUILayout.Button("Import Models Again"))
            {
                ModelImports.All();
                GUIUtility.ExitGUI();
            }
        }

        private static void Try()
        {
            var rows = DryRun.Run(ChamferProjectSettings.instance);
            if (rows != null) { DryRunWindow.Open(rows); }
            GUIUtility.ExitGUI();
        }
    }
}
