using System.Linq;
using System.Reflection;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class InspectorTests
    {
        private static ChamferModifier Modifier(Mesh mesh)
        {
            return Scene.Holding(mesh, "Item").AddComponent<ChamferModifier>();
        }

        private static ModifierInspector Inspector(params ChamferModifier[] modifiers)
        {
            Undo.Click();
            return new ModifierInspector
            {
                target = modifiers[0],
                targets = modifiers,
                serializedObject = new SerializedObject(modifiers[0])
            };
        }

        private static void Click(ModifierInspector inspector, string button)
        {
            GUILayout.clicked = button;
            try { Draw(inspector); }
            finally { GUILayout.clicked = null; }
        }

        /// As Unity does: it ends where the inspector says so, and complains of what is laid out after a dialogue.
        private static bool Draw(ModifierInspector inspector)
        {
            GUILayout.broken = false;
            GUILayout.depth = 0;
            try { inspector.OnInspectorGUI(); }
            catch (ExitGUIException) { return true; }
            Check.Equal(0, GUILayout.depth);
            return false;
        }

        /// What Unity draws after an inspector would be an error.
        public static void Clicks_end_what_is_drawn()
        {
            var inspector = Inspector(Modifier(Shapes.Cube()));
            Check.That(!Draw(inspector), "nothing was clicked on");
            foreach (string button in new[] { "Chamfer", "Save as Asset", "Revert" })
            {
                GUILayout.clicked = button;
                try { Check.That(Draw(inspector), button); }
                finally { GUILayout.clicked = null; }
            }
        }

        private static void ChangeSetting(ModifierInspector inspector)
        {
            SerializedObject.changed = true;
            try { Draw(inspector); }
            finally { SerializedObject.changed = false; }
            PreviewQueue.Flush();
        }

        public static void Buttons_act_on_all_selected()
        {
            ChamferModifier first = Modifier(Shapes.Cube()), second = Modifier(Shapes.Cube());
            var inspector = Inspector(first, second);
            Click(inspector, "Chamfer");
            Check.That(first.IsApplied && second.IsApplied, "chamfered");
            Click(inspector, "Revert");
            Check.That(!first.IsApplied && !second.IsApplied, "reverted");
        }

        public static void Only_the_button_looks_for_light()
        {
            var modifier = Modifier(Shapes.Cube());
            modifier.settings.verify = VerifyMode.Seen;
            var inspector = Inspector(modifier);
            Click(inspector, "Chamfer");
            Check.Equal(VerifyMode.Seen, modifier.meshes[0].settings.verify);
            ChangeSetting(inspector);
            Check.Equal(VerifyMode.Full, modifier.meshes[0].settings.verify);
        }

        public static void What_fails_is_told_for_all_selected()
        {
            Mesh bad = Shapes.Cube();
            bad.name = "Bad";
            bad.normals = new Vector3[0];
            var inspector = Inspector(Modifier(bad), Modifier(Shapes.Cube()));
            Click(inspector, "Chamfer");
            EditorGUILayout.boxes.Clear();
            Draw(inspector);
            Check.That(EditorGUILayout.boxes.Any(box => box.Contains("'Bad'")), "the failure of the first");
            Check.That(EditorGUILayout.boxes.Any(box => box.StartsWith("Cube: 24 -> 24 vertices")), "the report of the second");
        }

        public static void The_preview_follows_what_is_applied_only()
        {
            var modifier = Modifier(Shapes.Cube());
            modifier.showEdges = true;
            var inspector = Inspector(modifier);
            ChangeSetting(inspector);
            Check.That(!modifier.IsApplied, "the first click is the user's");
            Click(inspector, "Chamfer");
            modifier.settings.width = 5;
            ChangeSetting(inspector);
            Check.Near(0.1f, VerdictCache.Of(modifier.meshes[0]).Report.Width);
            modifier.livePreview = false;
            modifier.settings.width = 2;
            ChangeSetting(inspector);
            Check.Near(0.1f, VerdictCache.Of(modifier.meshes[0]).Report.Width);
        }

        public static void Nothing_is_reverted_or_saved_before_it_is_chamfered()
        {
            var inspector = Inspector(Modifier(Shapes.Cube()));
            EditorUtility.chosen = "/home/me/Game/Assets/Chosen";
            Click(inspector, "Save as Asset");
            Check.That(!AssetDatabase.paths.ContainsValue("Assets/Chosen/Cube Chamfered.asset"), "disabled");
            Click(inspector, "Chamfer");
            Click(inspector, "Save as Asset");
            EditorUtility.chosen = "";
            Check.That(AssetDatabase.paths.ContainsValue("Assets/Chosen/Cube Chamfered.asset"), "saved");
        }

        public static void Meshes_are_saved_in_the_project_only()
        {
            Check.Equal("Assets", ModifierActions.ProjectFolder("/game/Assets", "/game/Assets"));
            Check.Equal("Assets/Props", ModifierActions.ProjectFolder("/game/Assets/Props", "/game/Assets"));
            Check.Equal(null, ModifierActions.ProjectFolder("/game/AssetsElse", "/game/Assets"));
            var inspector = Inspector(Modifier(Shapes.Cube()));
            Click(inspector, "Chamfer");
            EditorUtility.chosen = "/tmp";
            Click(inspector, "Save as Asset");
            EditorUtility.chosen = "";
            EditorGUILayout.boxes.Clear();
            Draw(inspector);
            Check.That(EditorGUILayout.boxes.Any(box => box.Contains("inside the project's Assets")), "told");
        }

        public static void Edges_are_drawn_if_asked_for()
        {
            var modifier = Modifier(Shapes.Cube());
            var inspector = Inspector(modifier);
            Click(inspector, "Chamfer");
            var draw = typeof(ModifierInspector).GetMethod("OnSceneGUI", BindingFlags.Instance | BindingFlags.NonPublic);
            Handles.drawn.Clear();
            Handles.tested.Clear();
            draw.Invoke(inspector, null);
            Check.Equal(0, Handles.drawn.Count);
            modifier.showEdges = true;
            draw.Invoke(inspector, null);
            Check.Equal(24, Handles.drawn[Color.green]);
            Check.Equal(UnityEngine.Rendering.CompareFunction.LessEqual, Handles.tested[Color.green]);
            Check.That(Handles.tested.All(one => one.Key.a == 1 || one.Value == UnityEngine.Rendering.CompareFunction.Greater), "faint behind");
            Check.Equal(8, Handles.tested.Count);
            Check.Equal(UnityEngine.Rendering.CompareFunction.Always, Handles.zTest);
        }

        /// Bone 0 holds what is below, bone 1 what is above.
        public static void Edges_follow_the_bones()
        {
            var item = new GameObject("Skinned");
            var renderer = item.AddComponent<SkinnedMeshRenderer>();
            renderer.sharedMesh = Shapes.FullCube();
            var bones = new[] { new GameObject("Lower"), new GameObject("Upper") };
            bones[1].transform.localPosition = new Vector3(0, 10, 0);
            renderer.bones = new[] { bones[0].transform, bones[1].transform };
            var modifier = item.AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            Handles.points.Clear();
            VerdictOverlay.Draw(modifier);
            Check.Equal(11f, Handles.points.Max(p => p.y));
            Check.Equal(-1f, Handles.points.Min(p => p.y));
            Check.That(Handles.points.All(p => p.y == 11 || p.y == -1), "each end with its bone");
        }

        public static void Buttons_that_are_off_say_why()
        {
            var inspector = Inspector(Modifier(Shapes.Cube()));
            Draw(inspector);
            Check.That(GUILayout.tooltips["Revert"].Contains("press Chamfer"), "why");
            Click(inspector, "Chamfer");
            Draw(inspector);
            Check.Equal("", GUILayout.tooltips["Revert"]);
        }

        public static void Undo_of_a_setting_reaches_the_file()
        {
            ChamferProjectSettings.Listen();
            var project = ChamferProjectSettings.instance;
            Undo.Click();
            Undo.RecordObject(project, "Settings");
            project.settings.width = 7;
            project.Write();
            Check.Equal(7f, ChamferProjectSettings.Load().settings.width);
            int saves = UnityEditorInternal.InternalEditorUtility.saves;
            Undo.PerformUndo();
            Check.Equal(0.5f, ChamferProjectSettings.Load().settings.width);
            var item = new GameObject("Item");
            Undo.Click();
            Undo.RecordObject(item.transform, "Other");
            Undo.PerformUndo();
            Check.Equal(saves + 1, UnityEditorInternal.InternalEditorUtility.saves);
        }

        public static void The_settings_page_writes_what_was_changed()
        {
            var create = typeof(ChamferSettingsPage).GetMethod("Create", BindingFlags.Static | BindingFlags.NonPublic);
            var page = (SettingsProvider)create.Invoke(null, null);
            int saves = UnityEditorInternal.InternalEditorUtility.saves;
            GUILayout.broken = false;
            page.guiHandler("");
            Check.Equal(saves, UnityEditorInternal.InternalEditorUtility.saves);
            SerializedObject.changed = true;
            try { page.guiHandler(""); }
            finally { SerializedObject.changed = false; }
            Check.Equal(saves + 1, UnityEditorInternal.InternalEditorUtility.saves);
        }

        public static void The_settings_page_imports_again_on_demand()
        {
            var create = typeof(ChamferSettingsPage).GetMethod("Create", BindingFlags.Static | BindingFlags.NonPublic);
            var page = (SettingsProvider)create.Invoke(null, null);
            AssetDatabase.paths[new GameObject("Again")] = "Assets/Again/again.fbx";
            AssetDatabase.labels["Assets/Again/again.fbx"] = new[] { "Chamfer" };
            AssetDatabase.imported.Clear();
            GUILayout.broken = false;
            page.guiHandler("");
            Check.Equal(0, AssetDatabase.imported.Count);
            GUILayout.clicked = "Import Models Again";
            try { page.guiHandler(""); }
            catch (ExitGUIException) { }
            Check.That(AssetDatabase.imported.Contains("together: Assets/Again/again.fbx"), "imported");
        }
    }
}
