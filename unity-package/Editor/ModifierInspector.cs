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
            var action = DrawButtons();
            DrawReport();
            // Settings that nobody has applied yet are no preview: the first click is the user's.
            var previewed = Modifiers.Where(modifier => modifier.livePreview && modifier.IsApplied);
            if (changed) { previewed.Where(one => !SlotEditing.IsLocked(one)).ToList().ForEach(PreviewQueue.Request); }
            if (action == null) { return; }
            failures.Clear();
            foreach (var modifier in Modifiers) { PreviewQueue.Failures.Remove(modifier); }
            action();
            // Dialogs and progress bars leave the layout of this event behind them.
            GUIUtility.ExitGUI();
        }

        private bool DrawSettings()
        {
            serializedObject.Update();
            Draw("preset");
            using (new EditorGUI.DisabledScope(Modifiers.Any(modifier => modifier.preset != null))) { DrawOwnSettings(); }
            Draw("includeChildren", "livePreview", "showEdges");
            return serializedObject.ApplyModifiedProperties();
        }

        private void DrawOwnSettings()
        {
            Draw("settings.width", "settings.unit", "settings.segments", "settings.profile", "settings.verify",
                "settings.leastBreadth", "settings.evenness", "settings.submeshMode");
            var mode = serializedObject.FindProperty("settings.submeshMode");
            if (mode.intValue == (int)ChamferSubmesh.Given) { Draw("settings.submesh"); }
            Draw("settings.edges");
        }

        private void Draw(params string[] properties)
        {
            foreach (string property in properties)
            {
                EditorGUILayout.PropertyField(serializedObject.FindProperty(property), true);
            }
        }

        /// <summary>What the user clicked on; null for nothing.</summary>
        private Action DrawButtons()
        {
            Action action = null;
            string locked = Modifiers.Select(SlotEditing.WhyLocked).FirstOrDefault(reason => reason != null);
            bool isApplied = Modifiers.Any(modifier => modifier.IsApplied);
            string why = locked ?? (isApplied ? "" : "Nothing is chamfered yet: press Chamfer");
            EditorGUILayout.BeginHorizontal();
            using (new EditorGUI.DisabledScope(locked != null))
            {
                if (GUILayout.Button(new GUIContent("Chamfer", locked))) { action = ChamferAll; }
            }
            using (new EditorGUI.DisabledScope(locked != null || !isApplied))
            {
                if (GUILayout.Button(new GUIContent("Revert", why))) { action = Revert; }
                if (GUILayout.Button(new GUIContent("Save as Asset", why))) { action = Save; }
                if (GUILayout.Button(new GUIContent("Make LOD", why))) { action = MakeLods; }
            }
            EditorGUILayout.EndHorizontal();
            return action;
        }

        private void DrawReport()
        {
            var previews = Modifiers.Where(PreviewQueue.Failures.ContainsKey).SelectMany(one => PreviewQueue.Failures[one]);
            foreach (string failure in failures.Concat(previews)) { EditorGUILayout.HelpBox(failure, MessageType.Warning); }
            foreach (var modifier in Modifiers.Where(modifier => modifier.IsApplied))
            {
                if (ModifierState.IsOutdated(modifier)) { EditorGUILayout.HelpBox(ReportText.OutOfDate, MessageType.Warning); }
                EditorGUILayout.HelpBox(ReportText.Of(modifier), MessageType.None);
                bool isUnknown = modifier.showEdges && modifier.meshes.Any(entry => VerdictCache.Of(entry) == null);
                if (isUnknown) { EditorGUILayout.HelpBox(ReportText.EdgesUnknown, MessageType.Info); }
            }
        }

        private void OnSceneGUI()
        {
            var modifier = (ChamferModifier)target;
            if (modifier.showEdges) { VerdictOverlay.Draw(modifier); }
        }

        private void ChamferAll()
        {
            foreach (var modifier in Modifiers) { failures.AddRange(ModifierActions.Chamfer(modifier)); }
        }

        private void Revert()
        {
            foreach (var modifier in Modifiers) { ModifierActions.Revert(modifier); }
        }

        private void MakeLods()
        {
            failures.AddRange(Modifiers.Select(ModifierLods.Make).Where(why => why != null));
        }

        private void Save()
        {
            string chosen = EditorUtility.SaveFolderPanel("Save chamfered meshes", "Assets", "");
            if (string.IsNullOrEmpty(chosen)) { return; }
            string folder = ModifierActions.ProjectFolder(chosen, Application.dataPath);
            if (folder == null) { failures.Add("Choose a folder inside the project's Assets to save meshes in"); }
            else { foreach (var modifier in Modifiers) { ModifierActions.Save(modifier, folder); } }
        }
    }
}
