// Meshes that stand together: an edge stays where the rim of another object rests on it.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Threading;
using Chamfer;
using Chamfer.Streams;
using ChamferEditor;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class SceneTests
    {
        /// A gap that no contact bridges, and that nobody sees before chamfering.
        private const float Slit = 2.001f;

        private static Matrix4x4 At(float x)
        {
            return Placed(x, 1);
        }

        private static Matrix4x4 Placed(float x, float scale)
        {
            return Matrix4x4.TRS(new Vector3(x, 0, 0), new Quaternion(), new Vector3(scale, 1, 1));
        }

        private static ChamferSettings Settings(VerifyMode verify)
        {
            var settings = ChamferSettings.Default;
            settings.verify = verify;
            return settings;
        }

        private static int Held(ChamferReport report)
        {
            return report.Count(EdgeOutcome.Skipped, EdgeReason.Contact) + report.Count(EdgeOutcome.Narrowed, EdgeReason.Contact);
        }

        private static int HeldAt(float distance, VerifyMode verify)
        {
            Mesh cube = Shapes.Cube(), open = Shapes.OpenCube();
            var objects = new[] { new PlacedMesh(cube, Matrix4x4.identity), new PlacedMesh(open, At(distance)) };
            var results = MeshChamfer.RunScene(objects, Settings(verify));
            Check.Equal(2, results.Count);
            Check.Equal(12 * 3, cube.GetTriangles(0).Length);
            return Held(results[cube].Report);
        }

        public static void The_rim_of_another_object_holds_the_edges_that_it_rests_on()
        {
            foreach (var verify in new[] { VerifyMode.Fast, VerifyMode.Full, VerifyMode.Seen })
            {
                Check.Equal(4, HeldAt(2, verify));
                Check.Equal(0, HeldAt(2.5f, verify));
            }
        }

        public static void Only_who_looks_sees_light()
        {
            Check.Equal(0, HeldAt(Slit, VerifyMode.Full));
            Check.That(HeldAt(Slit, VerifyMode.Seen) >= 4, "held");
        }

        public static void A_mesh_in_several_places_is_chamfered_once()
        {
            Mesh cube = Shapes.Cube(), open = Shapes.OpenCube();
            var objects = new[]
            {
                new PlacedMesh(open, At(2)),
                new PlacedMesh(cube, Matrix4x4.identity),
                new PlacedMesh(open, Placed(-2, -1))
            };
            var results = MeshChamfer.RunSceneAsync(objects, ChamferSettings.Default).Result;
            Check.Equal(2, results.Count);
            Check.Equal(8, Held(results[cube].Report));
            Check.Equal("Cube", results[cube].Mesh.name);
        }

        public static void Nothing_comes_of_no_objects()
        {
            Check.Equal(0, MeshChamfer.RunScene(new PlacedMesh[0], ChamferSettings.Default).Count);
        }

        public static void What_is_wrong_names_the_mesh()
        {
            Mesh cube = Shapes.Cube(), open = Shapes.OpenCube();
            var positions = open.vertices;
            positions[5] = new Vector3(0, float.NaN, 0);
            open.vertices = positions;
            var objects = new[] { new PlacedMesh(cube, At(0)), new PlacedMesh(open, At(2)) };
            var exception = Check.Throws<InvalidMeshException>(() => MeshChamfer.RunScene(objects, ChamferSettings.Default));
            Check.Equal(5, exception.Element);
            Check.That(exception.Message.StartsWith("The mesh 'Open': positions of vertex 5"), exception.Message);
            objects[1] = new PlacedMesh(cube, At(float.NaN));
            string message = Check.Throws<InvalidSettingsException>(() => MeshChamfer.RunScene(objects, ChamferSettings.Default)).Message;
            Check.That(message.StartsWith("object 1 has a transform"), message);
            var settings = ChamferSettings.Default;
            settings.submeshMode = ChamferSubmesh.Given;
            settings.submesh = 1;
            Check.Throws<InvalidSettingsException>(() => MeshChamfer.RunScene(objects, settings));
            objects[1] = new PlacedMesh(null, At(0));
            Check.Throws<ArgumentNullException>(() => MeshChamfer.RunScene(objects, ChamferSettings.Default));
        }

        public static void Progress_rises_and_can_cancel()
        {
            var objects = new[] { new PlacedMesh(Shapes.Cube(), At(0)), new PlacedMesh(Shapes.OpenCube(), At(2)) };
            var told = new Told();
            MeshChamfer.RunScene(objects, Settings(VerifyMode.Seen), told);
            Check.That(told.Values.SequenceEqual(told.Values.OrderBy(share => share)), "rises");
            Check.That(told.Values[0] < 0.5f && told.Values.Last() == 1, "to the end");
            var source = new CancellationTokenSource();
            told = new Told { OnReport = share => source.Cancel() };
            Check.Throws<OperationCanceledException>(() => MeshChamfer.RunScene(objects, ChamferSettings.Default, told, source.Token));
            Check.Equal(1, told.Values.Count);
            told = new Told { OnReport = share => { throw new DivideByZeroException(); } };
            Check.Throws<DivideByZeroException>(() => MeshChamfer.RunScene(objects, ChamferSettings.Default, told));
        }

        /// The others are chamfered as if it were not there, in the places that they have.
        public static void A_mesh_at_fault_is_left_out()
        {
            foreach (bool isReadable in new[] { true, false })
            {
                Mesh bad = Shapes.FullCube(), cube = Shapes.Cube(), open = Shapes.OpenCube();
                bad.name = "Bad";
                bad.normals = new Vector3[0];
                // Such a mesh with a skin is refused before the library sees it.
                bad.readable = bad.canBeMadeReadable = isReadable;
                var objects = new[]
                {
                    new PlacedMesh(bad, At(0)), new PlacedMesh(cube, At(0)), new PlacedMesh(bad, At(1)), new PlacedMesh(open, At(2))
                };
                var told = new List<string>();
                var results = SceneRun.Run(objects, ChamferSettings.Default, null, CancellationToken.None, (why, mesh) =>
                {
                    told.Add(why);
                    Check.That(mesh == bad, "the mesh");
                });
                Check.That(told.Single().Contains("'Bad'"), told[0]);
                Check.Equal(2, results.Count);
                Check.That(results[0].Mesh == cube && Held(results[0].Output.Report) == 4, "the others");
            }
        }

        private static void ChamferAll(VerifyMode verify, params UnityEngine.Object[] items)
        {
            new ChamferSelection(items).Chamfer(Settings(verify));
        }

        public static void The_menu_takes_a_hierarchy_together()
        {
            GameObject resting = Scene.Resting(2), apart = Scene.Resting(2.5f);
            ChamferAll(VerifyMode.Full, resting);
            ChamferAll(VerifyMode.Full, apart);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(resting)), "held");
            Check.That(!Scene.KeepsEdges(Scene.MeshOf(apart)), "not held");
        }

        public static void The_menu_takes_all_selected_objects_of_a_scene_together()
        {
            GameObject cube = Scene.Holding(Shapes.Cube(), "Cube"), lid = Scene.Holding(Shapes.OpenCube(), "Lid");
            cube.transform.localPosition = new Vector3(5, 0, 0);
            lid.transform.localPosition = new Vector3(7, 0, 0);
            ChamferAll(VerifyMode.Full, cube, lid);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(cube)), "held");
        }

        public static void Grandchildren_stand_where_all_above_them_put_them()
        {
            var root = Scene.Holding(Shapes.Cube(), "Cube");
            GameObject arm = new GameObject("Arm"), lid = Scene.Holding(Shapes.OpenCube(), "Lid");
            root.children.Add(arm);
            arm.children.Add(lid);
            arm.transform.localPosition = new Vector3(4, 0, 0);
            arm.transform.localScale = new Vector3(2, 1, 1);
            lid.transform.localScale = new Vector3(0.5f, 1, 1);
            lid.transform.localPosition = new Vector3(-1, 0, 0);
            ChamferAll(VerifyMode.Full, root);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(root)), "held");
        }

        /// A mesh has one result: that of where it was selected first.
        public static void A_mesh_of_a_scene_and_a_prefab_is_that_of_the_scene()
        {
            var root = Scene.Resting(2);
            var prefab = Scene.Holding(Scene.MeshOf(root), "Prefab");
            Scene.MakeAsset(prefab, "Assets/Later/Cube.prefab");
            var lid = Scene.MeshOf(root.children[0]);
            prefab.children.Add(Scene.Holding(Shapes.Cube(), "Other"));
            ChamferAll(VerifyMode.Full, root, prefab);
            Check.That(Scene.MeshOf(root) == Scene.MeshOf(prefab), "one for both");
            Check.That(Scene.KeepsEdges(Scene.MeshOf(prefab)), "held");
            Check.That(lid != Scene.MeshOf(root.children[0]), "the other too");
        }

        public static void A_bad_mesh_of_several_scenes_is_told_once()
        {
            var bad = Shapes.Cube();
            bad.normals = new Vector3[0];
            GameObject item = Scene.Holding(bad, "Item"), prefab = Scene.Holding(bad, "Prefab");
            prefab.children.Add(Scene.Holding(Shapes.Cube(), "Good"));
            Scene.MakeAsset(prefab, "Assets/Bad/Bad.prefab");
            var summary = new ChamferSelection(new[] { item, prefab }).Chamfer(ChamferSettings.Default);
            Check.Equal(2, summary.ToString().Split('\n').Length);
        }

        /// Where all meshes of a scene have their results, it is not chamfered.
        public static void Scenes_with_nothing_new_take_no_time()
        {
            var mesh = Shapes.Cube();
            int calls = 0;
            EditorUtility.onProgress = share => { calls++; return false; };
            try
            {
                ChamferAll(VerifyMode.Fast, Scene.Holding(mesh, "Item"));
                int alone = calls;
                ChamferAll(VerifyMode.Fast, Scene.Holding(mesh, "Item"), mesh);
                Check.Equal(alone + 1, calls - alone);
            }
            finally { EditorUtility.onProgress = share => false; }
        }

        /// Edges that were kept are hard still.
        public static void A_second_run_keeps_what_the_first_kept()
        {
            var root = Scene.Resting(2);
            ChamferAll(VerifyMode.Seen, root);
            Mesh cube = Scene.MeshOf(root), lid = Scene.MeshOf(root.children[0]);
            Undo.Click();
            ChamferAll(VerifyMode.Seen, root);
            Check.That(Scene.MeshOf(root) == cube && Scene.MeshOf(root.children[0]) == lid, "the same meshes");
        }

        /// Each prefab has a space of its own.
        public static void Prefabs_do_not_stand_together()
        {
            GameObject cube = Scene.Holding(Shapes.Cube(), "Cube"), lid = Scene.Holding(Shapes.OpenCube(), "Lid");
            lid.transform.localPosition = new Vector3(2, 0, 0);
            Scene.MakeAsset(cube, "Assets/Alone/Cube.prefab");
            Scene.MakeAsset(lid, "Assets/Alone/Lid.prefab");
            ChamferAll(VerifyMode.Full, cube, lid);
            Check.That(!Scene.KeepsEdges(Scene.MeshOf(cube)), "not held");
        }

        /// The world has steps of a quarter there.
        public static void What_touches_is_told_far_from_the_worlds_origin()
        {
            GameObject world = new GameObject("World"), root = Scene.Resting(2), apart = Scene.Resting(2.1f);
            foreach (var item in new[] { root, apart })
            {
                world.children.Add(item);
                item.transform.localPosition = new Vector3(3000000, 0, 0);
                item.transform.localScale = new Vector3(1.1f, 1.1f, 1.1f);
            }
            ChamferAll(VerifyMode.Full, root);
            ChamferAll(VerifyMode.Full, apart);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(root)) && !Scene.KeepsEdges(Scene.MeshOf(apart)), "held where it rests");
        }

        /// It stands nowhere, and holds nothing.
        public static void What_is_scaled_to_nothing_is_chamfered_all_the_same()
        {
            var root = Scene.Resting(2);
            root.children[0].transform.localScale = new Vector3();
            ChamferAll(VerifyMode.Full, root);
            Check.Equal(44 * 3, Scene.MeshOf(root).GetTriangles(0).Length);
            Check.That(Scene.MeshOf(root.children[0]).GetTriangles(0).Length > 30, "the other too");
        }

        public static void The_modifier_takes_its_children_together_and_says_so()
        {
            var root = Scene.Resting(2);
            var modifier = root.AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            Check.That(!Scene.KeepsEdges(Scene.MeshOf(root)), "alone");
            Undo.Click();
            modifier.includeChildren = true;
            ModifierActions.Chamfer(modifier);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(root)), "with its children");
            string text = ReportText.Of(modifier);
            Check.That(text.Contains("\n  4 skipped: something rests there"), text);
        }

        /// Verdicts are of the chamfers that there are, so what moved since does not count.
        public static void Verdicts_are_found_again_where_the_meshes_stood()
        {
            foreach (float distance in new[] { 2, 2.5f })
            {
                var root = Scene.Resting(distance);
                var modifier = root.AddComponent<ChamferModifier>();
                modifier.includeChildren = true;
                ModifierActions.Chamfer(modifier);
                string text = ReportText.Of(modifier);
                root.children[0].transform.localPosition = new Vector3(4 - distance, 0, 0);
                var known = typeof(VerdictCache).GetField("known", BindingFlags.Static | BindingFlags.NonPublic);
                ((IDictionary)known.GetValue(null)).Clear();
                Check.Equal(text, ReportText.Of(modifier));
                root.children[0].transform.localPosition = new Vector3(5, 0, 0);
                Undo.Click();
                ModifierActions.Chamfer(modifier);
                Check.That(!ReportText.Of(modifier).Contains("rests"), "chamfered where it stands now");
            }
        }

        public static void A_preview_does_not_look_and_says_so()
        {
            var root = Scene.Resting(Slit);
            var modifier = root.AddComponent<ChamferModifier>();
            modifier.includeChildren = true;
            modifier.settings.verify = VerifyMode.Seen;
            ModifierActions.Chamfer(modifier);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(root)), "looked at");
            Check.That(!ReportText.Of(modifier).Contains("preview"), "no preview");
            Undo.Click();
            ModifierActions.Preview(modifier);
            Check.That(!Scene.KeepsEdges(Scene.MeshOf(root)), "not looked at");
            Check.That(ReportText.Of(modifier).EndsWith("press Chamfer"), ReportText.Of(modifier));
            Check.Equal(VerifyMode.Seen, modifier.settings.verify);
        }

        private static AssetImportContext Import(GameObject root)
        {
            AssetDatabase.labels["Assets/scene.fbx"] = new[] { "Chamfer" };
            var importer = new ModelChamfer { assetPath = "Assets/scene.fbx", context = new AssetImportContext() };
            var hook = typeof(ModelChamfer).GetMethod("OnPostprocessModel", BindingFlags.Instance | BindingFlags.NonPublic);
            hook.Invoke(importer, new object[] { root });
            return importer.context;
        }

        public static void A_model_is_imported_together_and_looked_at()
        {
            foreach (float distance in new[] { 2, Slit, 2.5f })
            {
                var root = Scene.Resting(distance);
                Check.Equal(0, Import(root).warnings.Count);
                Check.Equal(distance < 2.1f, Scene.KeepsEdges(Scene.MeshOf(root)));
                Check.That(Scene.MeshOf(root.children[0]).GetTriangles(0).Length > 30, "the other too");
            }
        }

        public static void A_bad_mesh_of_a_model_is_a_warning_and_the_others_are_chamfered()
        {
            var root = Scene.Resting(2);
            Scene.MeshOf(root.children[0]).normals = new Vector3[0];
            Check.That(Import(root).warnings.Single().Contains("'Open'"), "told");
            Check.Equal(44 * 3, Scene.MeshOf(root).GetTriangles(0).Length);
        }

        public static void Skinned_meshes_stand_where_their_renderer_does()
        {
            var root = Scene.Resting(2);
            var skinned = new GameObject("Skinned");
            skinned.AddComponent<SkinnedMeshRenderer>().sharedMesh = Scene.MeshOf(root.children[0]);
            skinned.transform.localPosition = root.children[0].transform.localPosition;
            root.children[0].GetComponents<MeshFilter>()[0].sharedMesh = null;
            root.children.Add(skinned);
            ChamferAll(VerifyMode.Full, root);
            Check.That(Scene.KeepsEdges(Scene.MeshOf(root)), "held");
        }

        public static void Batches_look_at_prefabs()
        {
            var root = Scene.Resting(Slit);
            Scene.MakeAsset(root, "Assets/Seen/Resting.prefab");
            Check.Equal(0, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/Seen" }));
            Check.That(Scene.KeepsEdges(Scene.MeshOf(root)), "held");
        }

        /// What the import will do is tried first.
        public static void Batches_try_models_as_a_whole()
        {
            var root = Scene.Resting(2);
            Scene.MakeAsset(root, "Assets/Whole/model.fbx");
            AssetDatabase.paths[Scene.MeshOf(root)] = "Assets/Whole/model.fbx";
            Check.Equal(0, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/Whole", "-chamferWidthPercent", "1" }));
            Check.That(Debug.logged.Last().EndsWith("4 skipped"), Debug.logged.Last());
        }

        public static void Projects_look_for_light_unless_they_say_otherwise()
        {
            Check.Equal(VerifyMode.Seen, new ChamferProjectSettings().settings.verify);
            Check.Equal(VerifyMode.Full, ChamferSettings.Default.verify);
        }
    }
}
