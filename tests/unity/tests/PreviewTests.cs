// The preview: another thread, one at a time, and nothing that nobody asked for.
using System.Collections;
using System.Linq;
using System.Reflection;
using Chamfer;
using Chamfer.Streams;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class PreviewTests
    {
        private static ChamferModifier Chamfered(Mesh mesh)
        {
            var modifier = Scene.Holding(mesh, "Item").AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            return modifier;
        }

        private static float WidthOf(ChamferModifier modifier)
        {
            return 1 - Scene.MeshOf(modifier.gameObject).vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y)));
        }

        public static void A_preview_is_what_the_button_makes()
        {
            foreach (var root in new[] { Scene.Holding(Shapes.FullCube(), "Full"), Scene.Resting(2) })
            {
                var modifier = root.AddComponent<ChamferModifier>();
                modifier.includeChildren = true;
                ModifierActions.Chamfer(modifier);
                string key = MeshKeys.Of(Scene.MeshOf(root)), text = ReportText.Of(modifier);
                Undo.Click();
                modifier.settings.width = 2;
                ModifierActions.Preview(modifier);
                Check.That(MeshKeys.Of(Scene.MeshOf(root)) != key, "another width");
                modifier.settings.width = 0.5f;
                ModifierActions.Preview(modifier);
                Check.Equal(key, MeshKeys.Of(Scene.MeshOf(root)));
                Check.Equal(text, ReportText.Of(modifier));
            }
        }

        public static void Only_the_newest_settings_are_previewed()
        {
            var modifier = Chamfered(Shapes.Cube());
            int repaints = SceneView.repaints;
            for (int width = 2; width < 10; width++)
            {
                modifier.settings.width = width;
                PreviewQueue.Request(modifier);
                Check.Near(0.01f, WidthOf(modifier));
            }
            PreviewQueue.Flush();
            Check.Near(0.18f, WidthOf(modifier));
            Check.Equal(2, SceneView.repaints - repaints);
        }

        public static void Previews_come_one_at_a_time()
        {
            ChamferModifier first = Chamfered(Shapes.Cube()), second = Chamfered(Shapes.Cube());
            foreach (var modifier in new[] { first, second })
            {
                modifier.settings.width = 5;
                PreviewQueue.Request(modifier);
            }
            while (WidthOf(first) < 0.05f) { EditorApplication.Idle(); }
            Check.Near(0.01f, WidthOf(second));
            while (WidthOf(second) < 0.05f) { EditorApplication.Idle(); }
            EditorApplication.Idle();
            Check.That(EditorApplication.update == null, "at rest");
        }

        public static void Objects_that_share_a_mesh_follow_at_once()
        {
            var cube = Shapes.Cube();
            var modifiers = Enumerable.Range(0, 20).Select(i => Chamfered(cube)).ToList();
            foreach (var modifier in modifiers)
            {
                modifier.settings.width = 5;
                PreviewQueue.Request(modifier);
            }
            while (WidthOf(modifiers[0]) < 0.05f) { EditorApplication.Idle(); }
            Check.That(modifiers.All(modifier => Scene.MeshOf(modifier.gameObject) == Scene.MeshOf(modifiers[0].gameObject)), "all of them");
            EditorApplication.Idle();
        }

        /// Letting go of the slider begins a new step.
        public static void The_last_preview_belongs_to_the_drag()
        {
            var modifier = Chamfered(Shapes.Cube());
            Undo.RecordObject(modifier, "Width");
            modifier.settings.width = 5;
            PreviewQueue.Request(modifier);
            Undo.Click();
            PreviewQueue.Flush();
            Check.Near(0.1f, WidthOf(modifier));
            Undo.PerformUndo();
            Check.Equal(0.5f, modifier.settings.width);
            Check.Near(0.01f, WidthOf(modifier));
        }

        public static void No_thread_is_at_work_when_scripts_are_loaded_anew()
        {
            var modifier = Chamfered(Shapes.Cube());
            modifier.settings.width = 5;
            PreviewQueue.Listen();
            PreviewQueue.Request(modifier);
            AssemblyReloadEvents.Reload();
            Check.Near(0.1f, WidthOf(modifier));
        }

        public static void What_is_gone_meanwhile_is_left_out()
        {
            var modifier = Chamfered(Shapes.Cube());
            modifier.settings.width = 5;
            PreviewQueue.Request(modifier);
            Object.DestroyImmediate(modifier);
            PreviewQueue.Flush();
            Check.Near(0.01f, WidthOf(modifier));
        }

        /// What the buttons did is newer than a preview that was asked for before.
        public static void Buttons_cancel_what_is_under_way()
        {
            ChamferModifier chamfered = Chamfered(Shapes.Cube()), reverted = Chamfered(Shapes.Cube()), other = Chamfered(Shapes.Cube());
            foreach (var modifier in new[] { chamfered, reverted, other })
            {
                modifier.settings.width = 5;
                PreviewQueue.Request(modifier);
            }
            chamfered.settings.verify = VerifyMode.Seen;
            ModifierActions.Chamfer(chamfered);
            ModifierActions.Revert(reverted);
            PreviewQueue.Flush();
            Check.Equal(VerifyMode.Seen, chamfered.meshes[0].settings.verify);
            Check.That(!reverted.IsApplied, "reverted while it waited");
            Check.Near(0.1f, WidthOf(other));
            ModifierActions.Chamfer(reverted);
            PreviewQueue.Request(reverted);
            ModifierActions.Revert(reverted);
            PreviewQueue.Flush();
            Check.That(!reverted.IsApplied, "reverted while it ran");
            other.settings.width = 6;
            PreviewQueue.Request(other);
            ModifierActions.Chamfer(reverted);
            PreviewQueue.Flush();
            Check.Near(0.12f, WidthOf(other));
        }

        public static void What_is_cancelled_does_not_work_on()
        {
            var modifier = Chamfered(Shapes.Cube());
            modifier.settings.width = 5;
            foreach (bool isCancelled in new[] { false, true })
            {
                var run = new PreviewRun(modifier);
                if (isCancelled) { run.Cancel(); }
                run.Work();
                var results = typeof(PreviewRun).GetField("results", BindingFlags.Instance | BindingFlags.NonPublic).GetValue(run);
                Check.Equal(isCancelled ? 0 : 1, ((ICollection)results).Count);
                Check.Equal(0, run.Failures.Count);
            }
        }

        public static void What_fails_in_a_preview_is_told()
        {
            var modifier = Chamfered(Shapes.Cube());
            modifier.settings.width = -1;
            var inspector = new ModifierInspector { target = modifier, targets = new Object[] { modifier }, serializedObject = new SerializedObject(modifier) };
            GUILayout.broken = false;
            SerializedObject.changed = true;
            try { inspector.OnInspectorGUI(); }
            finally { SerializedObject.changed = false; }
            PreviewQueue.Flush();
            EditorGUILayout.boxes.Clear();
            inspector.OnInspectorGUI();
            Check.That(PreviewQueue.Failures.ContainsKey(modifier), "told");
            Check.That(PreviewQueue.Failures[modifier].Single().Contains("width"), "why");
            Check.That(EditorGUILayout.boxes.Contains(PreviewQueue.Failures[modifier][0]), string.Join("\n", EditorGUILayout.boxes));
            Check.That(modifier.IsApplied, "all is as it was");
            Check.Near(0.01f, WidthOf(modifier));
        }

        public static void A_source_is_read_again_where_it_has_changed()
        {
            var mesh = Shapes.Cube();
            var modifier = Chamfered(mesh);
            modifier.settings.width = 2;
            ModifierActions.Preview(modifier);
            Check.That(PreviewSources.Read(mesh) == PreviewSources.Read(mesh), "kept");
            mesh.vertices = mesh.vertices.Select(p => p * 2).ToArray();
            modifier.settings.width = 3;
            ModifierActions.Preview(modifier);
            Check.Near(2, Scene.MeshOf(modifier.gameObject).vertices.Max(p => p.x));
            for (int i = 0; i < 20; i++) { PreviewSources.Read(Shapes.Cube()); }
            var kept = typeof(PreviewSources).GetField("sources", BindingFlags.Static | BindingFlags.NonPublic).GetValue(null);
            Check.Equal(8, ((ICollection)kept).Count);
            PreviewSources.Listen();
            Selection.selectionChanged();
            Check.Equal(0, ((ICollection)kept).Count);
            modifier.settings.width = 4;
            ModifierActions.Preview(modifier);
        }

        /// Selecting, unfolding, and loading scripts anew only look.
        public static void Nothing_is_chamfered_because_somebody_looks()
        {
            var modifier = Chamfered(Shapes.Cube());
            modifier.showEdges = true;
            string text = ReportText.Of(modifier);
            var known = typeof(VerdictCache).GetField("known", BindingFlags.Static | BindingFlags.NonPublic);
            ((IDictionary)known.GetValue(null)).Clear();
            var inspector = new ModifierInspector { target = modifier, targets = new Object[] { modifier }, serializedObject = new SerializedObject(modifier) };
            EditorGUILayout.boxes.Clear();
            GUILayout.broken = false;
            inspector.OnInspectorGUI();
            VerdictOverlay.Draw(modifier);
            Check.That(EditorGUILayout.boxes.Contains(text), "as it was written");
            Check.That(EditorGUILayout.boxes.Any(box => box.Contains("press Chamfer to see them")), "what is not known");
            Check.That(VerdictCache.Of(modifier.meshes[0]) == null, "nothing was chamfered");
            ModifierActions.Preview(modifier);
            Check.That(VerdictCache.Of(modifier.meshes[0]) != null, "kept where somebody looks");
            modifier.showEdges = false;
            modifier.settings.width = 2;
            ModifierActions.Preview(modifier);
            Check.That(VerdictCache.Of(modifier.meshes[0]) == null, "not kept where nobody does");
        }
    }
}
