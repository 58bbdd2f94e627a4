// What was chamfered can be reverted, and chamfered again.
using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class AgainTests
    {
        private static void ChamferAll(params Object[] items)
        {
            Undo.Click();
            new ChamferSelection(items).Chamfer(ChamferSettings.Default);
            Undo.Click();
        }

        private static void Grow(Mesh mesh)
        {
            mesh.vertices = mesh.vertices.Select(p => p * 2).ToArray();
        }

        private static float SizeOf(Mesh mesh) { return mesh.vertices.Max(p => p.x); }

        public static void What_the_menu_did_can_be_reverted()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            ChamferAll(root);
            Selection.objects = new Object[] { root };
            Check.That(ModifierMenu.CanRevert(), "there is something");
            ModifierMenu.RunRevert();
            Check.That(Scene.MeshOf(root) == shared && Scene.MeshOf(root.children[0]) == shared, "originals");
            Check.Equal(0, root.GetComponents<ChamferModifier>().Length);
            Check.Equal("Revert Chamfer", Undo.Last);
            Check.That(!ModifierMenu.CanRevert(), "nothing left");
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(root) != shared && root.GetComponent<ChamferModifier>().IsApplied, "undone in one step");
        }

        public static void Modifiers_of_the_user_stay()
        {
            var item = Scene.Holding(Shapes.Cube(), "Item");
            var modifier = item.AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            RevertSelection.Run(RevertSelection.Find(new Object[] { item, item }));
            Check.That(modifier != null && !modifier.IsApplied, "reverted");
        }

        public static void All_of_the_scenes_is_chamfered_again()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            ChamferAll(root);
            var modifier = root.GetComponent<ChamferModifier>();
            Grow(shared);
            var inspector = new ModifierInspector { target = modifier, targets = new Object[] { modifier }, serializedObject = new SerializedObject(modifier) };
            EditorGUILayout.boxes.Clear();
            GUILayout.broken = false;
            inspector.OnInspectorGUI();
            Check.That(EditorGUILayout.boxes.Contains(ReportText.OutOfDate), "shown");
            ModifierMenu.RunInScenes();
            Check.Equal(2f, SizeOf(Scene.MeshOf(root)));
            EditorGUILayout.boxes.Clear();
            GUILayout.broken = false;
            inspector.OnInspectorGUI();
            Check.That(!EditorGUILayout.boxes.Contains(ReportText.OutOfDate), "not any more");
            Undo.PerformUndo();
            Check.Equal(1f, SizeOf(Scene.MeshOf(root)));
        }

        public static void All_of_the_project_is_chamfered_again()
        {
            var prefab = Scene.Holding(Shapes.Cube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/AllAgain/Prefab.prefab");
            var variant = (GameObject)PrefabUtility.InstantiatePrefab(prefab);
            Mesh source = Scene.MeshOf(prefab), file = Shapes.Cube();
            AssetDatabase.paths[file] = "Assets/AllAgain/Cube.asset";
            ChamferAll(prefab, file);
            var saved = Scene.MeshesIn("Assets/AllAgain/Cube Chamfered.asset").Single();
            var later = (GameObject)PrefabUtility.InstantiatePrefab(prefab);
            foreach (var component in later.GetComponents<Component>()) { component.source = prefab.GetComponents<Component>().First(one => one.GetType() == component.GetType()); }
            Scene.MakeAsset(later, "Assets/AllAgain/Later.prefab");
            Grow(source);
            Grow(file);
            AssetDatabase.saved.Clear();
            ModifierMenu.RunInProject();
            Check.Equal(2f, SizeOf(Scene.MeshOf(prefab)));
            Check.Equal(2f, SizeOf(Scene.MeshOf(variant)));
            Check.Equal(2f, SizeOf(saved));
            Check.Equal(MeshKeys.Of(file), ChamferRecords.Of(saved).sourceKey);
            Check.That(AssetDatabase.saved.Contains("Assets/AllAgain/Prefab.prefab") && AssetDatabase.saved.Contains("Assets/AllAgain/Cube Chamfered.asset"), "saved");
            Check.Equal(1, Scene.MeshesIn("Assets/AllAgain/Prefab.prefab").Count);
            Check.That(!AssetDatabase.saved.Contains("Assets/AllAgain/Later.prefab"), "a variant follows");
            Undo.PerformUndo();
            Check.Equal(1f, SizeOf(saved));
        }
    }
}
