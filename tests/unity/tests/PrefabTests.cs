// Prefabs: in files, as variants and instances, and in a stage.
using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class PrefabTests
    {
        private static void ChamferAll(params GameObject[] items)
        {
            Undo.Click();
            new ChamferSelection(items).Chamfer(ChamferSettings.Default);
        }

        private static GameObject Prefab(Mesh mesh, string path)
        {
            var prefab = Scene.Holding(mesh, "Prefab");
            Scene.MakeAsset(prefab, path);
            return prefab;
        }

        private static void InStage(GameObject prefab, System.Action<PrefabStage> action)
        {
            StageMeshes.Listen();
            AssetDatabase.asked = false;
            try { action(PrefabStageUtility.Open(prefab)); }
            finally { PrefabStageUtility.Close(); }
            Check.That(!AssetDatabase.asked, "Unity would ask what to keep");
        }

        public static void Nothing_is_written_under_an_open_prefab()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Stage/Crate.prefab");
            InStage(prefab, stage =>
            {
                var item = stage.prefabContentsRoot;
                ChamferAll(item);
                Check.That(!AssetDatabase.Contains(Scene.MeshOf(item)), "in no file yet");
                stage.Save();
                Check.Equal("Assets/Stage/Cube Chamfered.asset", AssetDatabase.GetAssetPath(Scene.MeshOf(item)));
                stage.Save();
                Check.Equal(2, Scene.FilesIn("Assets/Stage/").Count);
            });
        }

        public static void Drags_in_a_stage_write_one_file()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Drags/Crate.prefab");
            InStage(prefab, stage =>
            {
                var modifier = stage.prefabContentsRoot.AddComponent<ChamferModifier>();
                for (int width = 1; width < 5; width++)
                {
                    Undo.Click();
                    modifier.settings.width = width;
                    ModifierActions.Chamfer(modifier);
                    stage.Save();
                }
                Check.Equal(2, Scene.FilesIn("Assets/Drags/").Count);
                Check.Near(0.92f, Scene.MeshOf(modifier.gameObject).vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
                Check.That(AssetDatabase.saved.Last() == "Assets/Drags/Cube Chamfered.asset", "saved with the prefab");
                Undo.PerformUndo();
                Check.Near(0.94f, Scene.MeshOf(modifier.gameObject).vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
            });
        }

        /// Unity gives a copy of a prefab the references of the prefab.
        public static void A_copy_of_a_prefab_keeps_its_mesh()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Copied/Crate.prefab");
            InStage(prefab, stage =>
            {
                var modifier = stage.prefabContentsRoot.AddComponent<ChamferModifier>();
                ModifierActions.Chamfer(modifier);
                stage.Save();
                var mesh = Scene.MeshOf(modifier.gameObject);
                // It need not be loaded.
                AssetDatabase.unloaded["Assets/Elsewhere/Copy.prefab"] = new[] { AssetDatabase.GetAssetPath(mesh) };
                Undo.Click();
                modifier.settings.width = 5;
                ModifierActions.Chamfer(modifier);
                Check.That(mesh.vertices.Any(p => p.x == 0.99f), "as it was");
                AssetDatabase.unloaded.Clear();
                Check.That(Scene.MeshOf(modifier.gameObject) != mesh, "a new one");
            });
        }

        public static void The_file_of_an_open_prefab_is_locked()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Locked/Crate.prefab");
            InStage(prefab, stage =>
            {
                var selection = new ChamferSelection(new[] { prefab });
                Check.That(selection.IsEmpty && selection.Reasons.Single().Contains("is open"), "and says why");
            });
        }

        public static void A_modifier_in_the_file_of_an_open_prefab_waits()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Waits/Crate.prefab");
            var modifier = prefab.AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            var mesh = Scene.MeshOf(prefab);
            InStage(prefab, stage =>
            {
                Check.That(ModifierActions.Chamfer(modifier).Single().Contains("is open"), "and says why");
                Check.That(ModifierActions.Preview(modifier).Single().Contains("is open"), "previews, too");
                ModifierActions.Revert(modifier);
                Check.That(Scene.MeshOf(prefab) == mesh && modifier.IsApplied, "as it was");
                var inspector = new ModifierInspector { target = modifier, targets = new Object[] { modifier }, serializedObject = new SerializedObject(modifier) };
                GUILayout.broken = false;
                inspector.OnInspectorGUI();
                Check.That(GUILayout.tooltips["Chamfer"].Contains("is open") && GUILayout.tooltips["Revert"].Contains("is open"), "buttons");
            });
        }

        public static void A_mesh_of_several_prefabs_gets_a_file_of_its_own()
        {
            var mesh = Shapes.Cube();
            GameObject first = Prefab(mesh, "Assets/Several/A.prefab"), second = Prefab(mesh, "Assets/Several/B.prefab");
            ChamferAll(second, first);
            Check.Equal("Assets/Several/Cube Chamfered.asset", AssetDatabase.GetAssetPath(Scene.MeshOf(first)));
            Check.That(Scene.MeshOf(first) == Scene.MeshOf(second), "one for both");
            Check.That(AssetDatabase.IsMainAsset(Scene.MeshOf(first)), "of its own");
            // One of them goes another way.
            Undo.Click();
            var modifier = first.GetComponent<ChamferModifier>();
            modifier.settings.width = 5;
            ModifierActions.Chamfer(modifier);
            Check.That(Scene.MeshOf(second).vertices.Any(p => p.x == 0.99f), "the other stays");
            Undo.PerformUndo();
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(second) == mesh, "undone");
        }

        /// Dragging it into a scene again would be two changes for one.
        public static void Variants_and_instances_whose_base_is_processed_follow_it()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Base/Crate.prefab");
            var variant = (GameObject)PrefabUtility.InstantiatePrefab(prefab);
            Scene.MakeAsset(variant, "Assets/Base/Variant.prefab");
            var instance = (GameObject)PrefabUtility.InstantiatePrefab(variant);
            int before = PrefabUtility.modified.Count;
            ChamferAll(instance, variant, prefab);
            Check.Equal(44 * 3, Scene.MeshOf(instance).GetTriangles(0).Length);
            Check.That(Scene.MeshOf(instance) == Scene.MeshOf(prefab), "the base's");
            Check.Equal(before, PrefabUtility.modified.Count);
            Check.Equal(0, Scene.MeshesIn("Assets/Base/Variant.prefab").Count);
        }

        public static void A_variant_with_a_mesh_of_its_own_is_chamfered()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Own/Crate.prefab");
            var variant = (GameObject)PrefabUtility.InstantiatePrefab(prefab);
            variant.GetComponent<MeshFilter>().sharedMesh = Shapes.OpenCube();
            PrefabUtility.RecordPrefabInstancePropertyModifications(variant.GetComponent<MeshFilter>());
            Scene.MakeAsset(variant, "Assets/Own/Variant.prefab");
            ChamferAll(variant, prefab);
            Check.That(Scene.MeshOf(variant) != Scene.MeshOf(prefab), "of its own");
            Check.Equal("Assets/Own/Variant.prefab", AssetDatabase.GetAssetPath(Scene.MeshOf(variant)));
        }

        public static void Changes_of_instances_are_recorded()
        {
            var prefab = Prefab(Shapes.Cube(), "Assets/Recorded/Crate.prefab");
            var instance = (GameObject)PrefabUtility.InstantiatePrefab(prefab);
            ChamferAll(instance);
            var chamfered = Scene.MeshOf(instance);
            instance.GetComponent<MeshFilter>().Merge();
            Check.That(Scene.MeshOf(instance) == chamfered && Scene.MeshOf(prefab) != chamfered, "kept");
        }

        public static void Reasons_say_what_to_do()
        {
            var model = Scene.Holding(Shapes.Cube(), "Model");
            Scene.MakeAsset(model, "Assets/Why/model.fbx");
            var locked = Scene.Holding(Shapes.Cube(), "Locked");
            Scene.MakeAsset(locked, "Packages/com.other/Locked.prefab");
            var reasons = new ChamferSelection(new[] { model, locked }).Reasons.ToList();
            Check.That(reasons[0].Contains("label Chamfer") && reasons[1].Contains("variant"), string.Join("\n", reasons));
            Selection.objects = new Object[] { model };
            Check.That(ChamferMenu.CanRun(), "there is something to say");
            EditorUtility.dialogs.Clear();
            ChamferMenu.Run();
            Check.That(EditorUtility.dialogs.Single().Contains("model.fbx was imported"), EditorUtility.dialogs.Single());
        }
    }
}
