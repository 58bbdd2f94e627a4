using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The inspector of <see cref="ChamferModifier"/>.</summary>
    [CustomEditor(typeof(ChamferModifier)), CanEditMultipleObjects]
    internal sealed class ModifierInspector : Editor
    {
        private readonly List<string> failures = new List<string>();

        private IEnumerable<ChamferModifier> Modifiers => targets.Cast<ChamferModifier>();

        public override void OnInspectorGUI()
        {
            bool changed = DrawSettings();
            DrawButtons();
            DrawReport();
            // Settings that nobody has applied yet are no preview: the first click is the user's.
            if (changed) { Preview(Modifiers.Where(modifier => modifier.livePreview && modifier.IsApplied)); }
        }

        private bool DrawSettings()
        {
            serializedObject.Update();
            Draw("settings.width", "settings.unit", "settings.verify", "settings.submeshMode");
            var mode = serializedObject.FindProperty("settings.submeshMode");
            if (mode.intValue == (int)ChamferSubmesh.Given) { Draw("settings.submesh"); }
            Draw("includeChildren", "livePreview", "showEdges");
            return serializedObject.ApplyModifiedProperties();
        }

        private void Draw(params string[] properties)
        {
            foreach (string property in properties)
            {
                EditorGUILayout.PropertyField(serializedObject.FindProperty(property));
            }
        }

        private void DrawButtons()
        {
            EditorGUILayout.BeginHorizontal();
            if (GUILayout.Button("Chamfer")) { Chamfer(Modifiers); }
            using (new EditorGUI.DisabledScope(!Modifiers.Any(modifier => modifier.IsApplied)))
            {
                if (GUILayout.Button("Revert")) { ForEach(ModifierActions.Revert); }
                if (GUILayout.Button("Save as Asset")) { Save(); }
            }
            EditorGUILayout.EndHorizontal();
        }

        private void DrawReport()
        {
            foreach (string failure in failures) { EditorGUILayout.HelpBox(failure, MessageType.Warning); }
            foreach (var modifier in Modifiers.Where(modifier => modifier.IsApplied))
            {
                EditorGUILayout.HelpBox(ReportText.Of(modifier), MessageType.None);
            }
        }

        private void OnSceneGUI()
        {
            var modifier = (ChamferModifier)target;
            if (modifier.showEdges) { VerdictOverlay.Draw(modifier); }
        }

        private void Chamfer(IEnumerable<ChamferModifier> modifiers)
        {
            failures.Clear();
            foreach (var modifier in modifiers) { failures.AddRange(ModifierActions.Chamfer(modifier)); }
        }

        private void Preview(IEnumerable<ChamferModifier> modifiers)
        {
            failures.Clear();
            foreach (var modifier in modifiers) { failures.AddRange(ModifierActions.Preview(modifier)); }
        }

        private void Save()
        {
            string chosen = EditorUtility.SaveFolderPanel("Save chamfered meshes", "Assets", "");
            if (string.IsNullOrEmpty(chosen)) { return; }
            failures.Clear();
            string folder = ModifierActions.ProjectFolder(chosen, Application.dataPath);
            if (folder == null) { failures.Add("Choose a folder inside the project's Assets to save meshes in"); }
            else { ForEach(modifier => ModifierActions.Save(modifier, folder)); }
        }

        private void ForEach(Action<ChamferModifier> action)
        {
            foreach (var modifier in Modifiers) { action(modifier); }
        }
    }
}
