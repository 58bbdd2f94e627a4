using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Shows what the rules of the project would change.</summary>
    internal sealed class DryRunWindow : EditorWindow
    {
        private const float PictureSize = 64;

        private List<DryRunRow> rows = new List<DryRunRow>();
        private Vector2 scroll;

        internal static void Open(List<DryRunRow> rows)
        {
            var window = GetWindow<DryRunWindow>("Chamfer Rules");
            window.rows = rows;
            window.Show();
        }

        private void OnGUI()
        {
            EditorGUILayout.HelpBox(DryRun.Summary(rows), MessageType.Info);
            scroll = EditorGUILayout.BeginScrollView(scroll);
            foreach (var row in rows) { Draw(row); }
            EditorGUILayout.EndScrollView();
        }

        private static void Draw(DryRunRow row)
        {
            var model = AssetDatabase.LoadMainAssetAtPath(row.Path);
            EditorGUILayout.BeginHorizontal();
            // Unity draws pictures when it has time, and has none until then.
            GUILayout.Label(AssetPreview.GetAssetPreview(model), GUILayout.Width(PictureSize), GUILayout.Height(PictureSize));
            EditorGUILayout.BeginVertical();
            if (GUILayout.Button(row.Path)) { EditorGUIUtility.PingObject(model); }
            EditorGUILayout.LabelField(row.Text, EditorStyles.wordWrappedLabel);
            EditorGUILayout.EndVertical();
            EditorGUILayout.EndHorizontal();
        }
    }
}
