// Files of chamfered meshes: their names, and that none is lost.
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class AssetTests
    {
        private static JobSummary ChamferAll(params Object[] items)
        {
            Undo.Click();
            return new ChamferSelection(items).Chamfer(ChamferSettings.Default);
        }

        private static Mesh Cube(string path, string name = "Cube")
        {
            var mesh = Shapes.Cube();
            mesh.name = name;
            AssetDatabase.paths[mesh] = path;
            return mesh;
        }

        public static void Meshes_of_one_name_from_several_files_get_files_of_their_own()
        {
            Mesh first = Cube("Assets/Same/a.fbx"), second = Cube("Assets/Same/b.fbx"), third = Cube("Assets/Same/b.fbx");
            ChamferAll(first, second, third);
            foreach (string name in new[] { "a Cube Chamfered", "b Cube Chamfered", "b Cube Chamfered 1" })
            {
                Check.Equal(1, Scene.MeshesIn("Assets/Same/" + name + ".asset").Count);
            }
        }

        public static void A_file_that_somebody_else_made_is_not_overwritten()
        {
            var theirs = Cube("Assets/Theirs/Cube Chamfered.asset");
            ChamferAll(Cube("Assets/Theirs/Cube.asset"));
            Check.That(theirs != null, "theirs");
            Check.Equal(12 * 3, theirs.GetTriangles(0).Length);
            Check.Equal(1, Scene.MeshesIn("Assets/Theirs/Cube Chamfered 1.asset").Count);
        }

        public static void Names_do_on_every_system()
        {
            Check.Equal("a_b_c_ Chamfered", AssetNames.Of(new Mesh { name = "a/b:c?" }));
            Check.Equal("Mesh Chamfered", AssetNames.Of(new Mesh { name = ". " }));
            Check.Equal("Mesh Chamfered", AssetNames.Of(new Mesh { name = "" }));
            ChamferAll(Cube("Assets/Odd/crate.fbx", "Box|01"));
            Check.Equal(1, Scene.MeshesIn("Assets/Odd/crate Box_01 Chamfered.asset").Count);
            var modifier = Scene.Holding(Cube("Assets/Odd/odd.fbx", "x*y"), "Odd").AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            Check.Equal("Assets/Odd/Kept/odd x_y Chamfered.asset", ModifierActions.Save(modifier, "Assets/Odd/Kept").Single());
        }

        public static void Meshes_of_packages_are_saved_in_the_project()
        {
            var mesh = Cube("Packages/com.other/Parts/part.fbx", "Bolt");
            for (int time = 0; time < 2; time++) { ChamferAll(mesh); }
            Check.Equal(1, Scene.MeshesIn("Assets/part Bolt Chamfered.asset").Count);
            Check.Equal(0, Scene.MeshesIn("Assets/part Bolt Chamfered 1.asset").Count);
            Check.Equal("Cube Chamfered", AssetNames.Of(Cube("Library/unity default resources")));
        }

        public static void A_file_that_was_renamed_is_found_again()
        {
            var mesh = Cube("Assets/Renamed/Cube.asset");
            ChamferAll(mesh);
            var result = Scene.MeshesIn("Assets/Renamed/Cube Chamfered.asset").Single();
            foreach (var asset in AssetDatabase.LoadAllAssetsAtPath("Assets/Renamed/Cube Chamfered.asset")) { AssetDatabase.paths[asset] = "Assets/Renamed/Nice.asset"; }
            Undo.Click();
            var wide = ChamferSettings.Default;
            wide.width = 5;
            new ChamferSelection(new[] { mesh }).Chamfer(wide);
            Check.Equal(2, Scene.FilesIn("Assets/Renamed/").Count);
            Check.Near(0.9f, result.vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
            Undo.PerformUndo();
            Check.Near(0.99f, result.vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
            Check.Equal(0.5f, ChamferRecords.Of(result).settings.width);
        }

        public static void An_exception_midway_leaves_everything_as_it_was()
        {
            var mesh = Cube("Assets/Full/Cube.asset");
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            GameObject prefab = Scene.Holding(Shapes.Cube(), "Prefab"), full = Scene.Holding(Shapes.Cube(), "Full");
            Scene.MakeAsset(prefab, "Assets/Full/Prefab.prefab");
            Scene.MakeAsset(full, "Assets/Full/Full.prefab");
            var original = Scene.MeshOf(prefab);
            string last = Undo.Last;
            AssetDatabase.fails = path => path.EndsWith("Full.prefab");
            try { Check.Throws<UnityException>(() => ChamferAll(mesh, root, prefab, full)); }
            finally { AssetDatabase.fails = path => false; }
            Check.That(Scene.MeshOf(root) == shared && Scene.MeshOf(prefab) == original, "objects");
            Check.Equal(0, root.GetComponents<ChamferModifier>().Length + prefab.GetComponents<ChamferModifier>().Length);
            Check.Equal(3, Scene.FilesIn("Assets/Full/").Count);
            Check.Equal(last, Undo.Last);
        }

        public static void One_step_takes_files_that_were_written_anew_back()
        {
            var mesh = Cube("Assets/Anew/Cube.asset");
            ChamferAll(mesh);
            var root = Scene.Holding(Shapes.Cube(), "Root");
            Undo.Click();
            var wide = ChamferSettings.Default;
            wide.width = 5;
            new ChamferSelection(new Object[] { mesh, root }).Chamfer(wide);
            var saved = Scene.MeshesIn("Assets/Anew/Cube Chamfered.asset").Single();
            Check.That(!saved.vertices.Any(p => p.x == 0.99f), "wide");
            Undo.PerformUndo();
            Check.That(saved.vertices.Any(p => p.x == 0.99f), "as before");
            Check.Equal(0, root.GetComponents<ChamferModifier>().Length);
        }

        /// Whatever was done before in the same event.
        public static void A_step_begins_anew()
        {
            var item = new GameObject("Item");
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            Undo.RecordObject(item.transform, "Move");
            item.transform.localPosition = new Vector3(1, 2, 3);
            new ChamferSelection(new[] { root }).Chamfer(ChamferSettings.Default);
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(root) == shared, "undone");
            Check.Equal(2f, item.transform.localPosition.y);
        }

        public static void Only_what_was_changed_is_saved()
        {
            int before = AssetDatabase.savedAll;
            AssetDatabase.saved.Clear();
            var prefab = Scene.Holding(Shapes.Cube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/OnlySaved/Prefab.prefab");
            ChamferAll(Cube("Assets/OnlySaved/Cube.asset"), prefab);
            Check.That(AssetDatabase.saved.Contains("Assets/OnlySaved/Prefab.prefab"), "the prefab");
            Check.That(AssetDatabase.saved.Contains("Assets/OnlySaved/Cube Chamfered.asset"), "the mesh");
            AssetDatabase.saved.Clear();
            var modifier = Scene.Holding(Shapes.Cube(), "Item").AddComponent<ChamferModifier>();
            ModifierActions.Chamfer(modifier);
            ModifierActions.Save(modifier, "Assets/OnlySaved/Kept");
            Check.That(AssetDatabase.saved.All(path => path == "Assets/OnlySaved/Kept/Cube Chamfered.asset"), "the file only");
            Check.Equal(before, AssetDatabase.savedAll);
        }

        /// Undo destroys what it knows to have been made; a file would stay behind with nothing in it.
        public static void Undo_does_not_destroy_what_was_saved()
        {
            var modifier = Scene.Holding(Shapes.Cube(), "Item").AddComponent<ChamferModifier>();
            Undo.Click();
            ModifierActions.Chamfer(modifier);
            var mesh = Scene.MeshOf(modifier.gameObject);
            ModifierActions.Save(modifier, "Assets/Undone");
            Undo.PerformUndo();
            Check.That(mesh != null && Scene.MeshOf(modifier.gameObject) != mesh, "the file is the user's");
        }

        private static void Twice(System.Func<JobSummary> run, System.Func<string> state)
        {
            run();
            string once = state();
            string last = Undo.Last;
            Undo.Click();
            Check.That(run().ToString().StartsWith("0 meshes"), "nothing to do");
            Check.Equal(once, state());
            Check.Equal(last, Undo.Last);
        }

        /// At a width that leaves edges hard: a second run would find them.
        public static void A_second_run_changes_nothing()
        {
            var settings = ChamferSettings.Default;
            settings.width = 40;
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            Twice(() => new ChamferSelection(new[] { root }).Chamfer(settings), () => Scene.MeshOf(root).GetHashCode() + " " + Scene.MeshOf(root).version);
            var prefab = Scene.Holding(Shapes.OpenCube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/Twice/Prefab.prefab");
            Twice(() => new ChamferSelection(new[] { prefab }).Chamfer(settings), () => Scene.MeshOf(prefab).GetHashCode() + " " + Scene.MeshOf(prefab).version);
        }

        public static void Results_are_known_wherever_they_went()
        {
            var source = Cube("Assets/Known/Cube.asset");
            ChamferAll(source);
            var result = Scene.MeshesIn("Assets/Known/Cube Chamfered.asset").Single();
            // As if there were edges that were left hard.
            result.SetTriangles(source.GetTriangles(0), 0);
            result.normals = source.normals;
            result.vertices = source.vertices;
            var item = Scene.Holding(result, "Item");
            ChamferAll(item, result);
            Check.That(Scene.MeshOf(item) == result, "a saved result");
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            ChamferAll(root);
            var alone = Scene.Holding(Scene.MeshOf(root), "Alone");
            Check.That(ChamferAll(alone).ToString().EndsWith("1 mesh chamfered already left alone"), "a result of a scene");
            Check.Equal(0, alone.GetComponents<ChamferModifier>().Length);
        }

        public static void A_source_that_changed_is_chamfered_again()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            ChamferAll(root);
            shared.vertices = System.Array.ConvertAll(shared.vertices, p => p * 2);
            Check.That(ModifierState.IsOutdated(root.GetComponent<ChamferModifier>()), "out of date");
            ChamferAll(root);
            Check.Near(2, Scene.MeshOf(root).vertices.Max(p => p.x));
            Check.That(!ModifierState.IsOutdated(root.GetComponent<ChamferModifier>()), "as it should be");
        }

        public static void What_a_modifier_has_not_chamfered_yet_gets_its_settings()
        {
            var item = Scene.Holding(Shapes.Cube(), "Item");
            item.AddComponent<ChamferModifier>().settings.width = 5;
            ChamferAll(item);
            Check.Near(0.9f, Scene.MeshOf(item).vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
            Check.Equal(1, item.GetComponents<ChamferModifier>().Length);
        }

        public static void Keys_tell_meshes_by_what_they_hold()
        {
            Check.Equal(MeshKeys.Of(Shapes.FullCube()), MeshKeys.Of(Shapes.FullCube()));
            var changes = new System.Action<Mesh>[]
            {
                mesh => mesh.vertices = mesh.vertices.Select(p => p * 2).ToArray(),
                mesh => mesh.normals = mesh.normals.Select(p => p * -1).ToArray(),
                mesh => mesh.tangents = new Vector4[24],
                mesh => mesh.colors = new Color[24],
                mesh => mesh.SetUVs(7, new Vector3[24]),
                mesh => mesh.SetTriangles(new[] { 0, 1, 2 }, 0),
                mesh => mesh.bindposes = new Matrix4x4[2],
                mesh => mesh.ClearBlendShapes()
            };
            var keys = new HashSet<string> { MeshKeys.Of(Shapes.FullCube()) };
            foreach (var change in changes)
            {
                var mesh = Shapes.FullCube();
                change(mesh);
                Check.That(keys.Add(MeshKeys.Of(mesh)), "another key");
            }
            Check.Equal("d9c660c6984ec73f", MeshKeys.Of(Shapes.Cube()));
        }
    }
}
