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
            try { inspector.OnInspectorGUI(); }
            finally { GUILayout.clicked = null; }
        }

        private static void ChangeSetting(ModifierInspector inspector)
        {
            SerializedObject.changed = true;
            try { inspector.OnInspectorGUI(); }
            finally { SerializedObject.changed = false; }
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
            inspector.OnInspectorGUI();
            Check.That(EditorGUILayout.boxes.Any(box => box.Contains("'Bad'")), "the failure of the first");
            Check.That(EditorGUILayout.boxes.Any(box => box.StartsWith("Cube: 24 -> 24 vertices")), "the report of the second");
        }

        public static void The_preview_follows_what_is_applied_only()
        {
            var modifier = Modifier(Shapes.Cube());
            var inspector = Inspector(modifier);
            ChangeSetting(inspector);
            Check.That(!modifier.IsApplied, "the first click is the user's");
            Click(inspector, "Chamfer");
            modifier.settings.width = 5;
            ChangeSetting(inspector);
            Check.Near(0.1f, VerdictCache.Of(modifier, modifier.meshes[0]).Report.Width);
            modifier.livePreview = false;
            modifier.settings.width = 2;
            ChangeSetting(inspector);
            Check.Near(0.1f, VerdictCache.Of(modifier, modifier.meshes[0]).Report.Width);
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
            inspector.OnInspectorGUI();
            Check.That(EditorGUILayout.boxes.Any(box => box.Contains("inside the project's Assets")), "told");
        }

        public static void Edges_are_drawn_if_asked_for()
        {
            var modifier = Modifier(Shapes.Cube());
            var inspector = Inspector(modifier);
            Click(inspector, "Chamfer");
            var draw = typeof(ModifierInspector).GetMethod("OnSceneGUI", BindingFlags.Instance | BindingFlags.NonPublic);
            Handles.drawn.Clear();
            draw.Invoke(inspector, null);
            Check.Equal(0, Handles.drawn.Count);
            modifier.showEdges = true;
            draw.Invoke(inspector, null);
            Check.Equal(24, Handles.drawn[Color.green]);
        }

        public static void The_settings_page_imports_again_on_demand()
        {
            var create = typeof(ChamferSettingsPage).GetMethod("Create", BindingFlags.Static | BindingFlags.NonPublic);
            var page = (SettingsProvider)create.Invoke(null, null);
            int imports = AssetDatabase.imported.Count;
            page.guiHandler("");
            Check.Equal(imports, AssetDatabase.imported.Count);
            GUILayout.clicked = "Import Models Again";
            page.guiHandler("");
            Check.That(AssetDatabase.imported.Count > imports, "imported");
        }
    }
}
