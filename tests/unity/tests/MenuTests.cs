using System.Linq;
using System.Reflection;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class MenuTests
    {
        private static JobSummary ChamferAll(params Object[] items)
        {
            return new ChamferSelection(items).Chamfer(ChamferSettings.Default);
        }

        public static void A_hierarchy_is_chamfered_and_shared_meshes_once()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            string summary = ChamferAll(root, root.children[0]).ToString();
            Check.Equal("2 meshes: 24 edges full, 0 narrowed, 0 skipped", summary);
            Check.That(Scene.MeshOf(root) != shared, "a new mesh");
            Check.That(Scene.MeshOf(root) == Scene.MeshOf(root.children[0]), "one for both");
            Check.Equal("Cube Chamfered", Scene.MeshOf(root).name);
            Check.Equal(12 * 3, shared.GetTriangles(0).Length);
            Check.That(!EditorUtility.barShown, "the bar is gone");
        }

        public static void A_mesh_whose_normals_are_smooth_is_left_with_a_word()
        {
            var smooth = Shapes.Cube();
            smooth.normals = smooth.vertices.Select(corner => corner * 0.5773503f).ToArray();
            string summary = ChamferAll(Scene.Holding(smooth, "Ball")).ToString();
            Check.That(summary.Contains("1 mesh without hard edges left alone (all normals are smooth"), summary);
        }

        public static void One_undo_takes_all_of_it_back()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            var skinned = Scene.MeshOf(root.children[0].children[0]);
            ChamferAll(root);
            var made = Scene.MeshOf(root);
            Check.Equal("Chamfer Selected", Undo.Last);
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(root) == shared && Scene.MeshOf(root.children[0]) == shared, "shared mesh");
            Check.That(Scene.MeshOf(root.children[0].children[0]) == skinned, "skinned mesh");
            Check.That(made == null, "the new mesh is gone");
        }

        public static void Materials_and_transforms_are_kept()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            var materials = root.GetComponents<Renderer>()[0].sharedMaterials;
            ChamferAll(root);
            Check.That(materials.SequenceEqual(root.GetComponents<Renderer>()[0].sharedMaterials), "materials");
            Check.Equal(1, root.GetComponentsInChildren<ChamferModifier>(true).Length);
            Check.Equal(0, root.children[0].GetComponents<ChamferModifier>().Length);
        }

        public static void A_submesh_of_their_own_has_a_material()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            var settings = ChamferSettings.Default;
            settings.submeshMode = ChamferSubmesh.Own;
            new ChamferSelection(new[] { root }).Chamfer(settings);
            var materials = root.GetComponents<Renderer>()[0].sharedMaterials;
            Check.Equal(2, Scene.MeshOf(root).subMeshCount);
            Check.That(materials.Length == 2 && materials[0] == materials[1], "repeated");
            Undo.PerformUndo();
            Check.Equal(1, root.GetComponents<Renderer>()[0].sharedMaterials.Length);
        }

        public static void Cancelling_half_way_changes_nothing()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            string last = Undo.Last;
            EditorUtility.onProgress = share => share > 0.5f;
            try { Check.Equal(null, ChamferAll(root)); }
            finally { EditorUtility.onProgress = share => false; }
            Check.That(Scene.MeshOf(root) == shared, "mesh");
            Check.Equal(last, Undo.Last);
            Check.That(!EditorUtility.barShown, "the bar is gone");
        }

        public static void A_bad_mesh_is_told_and_the_others_are_chamfered()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            shared.normals = new Vector3[0];
            var summary = ChamferAll(root);
            Check.That(summary.HasFailed, "failed");
            Check.That(summary.ToString().StartsWith("1 mesh: 12 edges") && summary.ToString().Contains("'Cube'"), "" + summary);
            Check.That(Scene.MeshOf(root) == shared, "left alone");
        }

        public static void What_is_chamfered_already_is_left_alone()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            ChamferAll(root);
            var once = Scene.MeshOf(root);
            string summary = ChamferAll(root).ToString();
            Check.That(Scene.MeshOf(root) == once, "the same mesh");
            Check.That(summary.EndsWith("2 meshes chamfered already left alone"), summary);
        }

        public static void Validators_look_at_the_selection()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            Selection.objects = new Object[0];
            Check.That(!ChamferMenu.CanRun(), "nothing");
            Selection.objects = new Object[] { new GameObject("Empty") };
            Check.That(!ChamferMenu.CanRun(), "no mesh");
            Selection.objects = new Object[] { root };
            Check.That(ChamferMenu.CanRun(), "a hierarchy");
            Selection.objects = new Object[] { shared };
            Check.That(ChamferMenu.CanRun(), "a mesh asset");
            ChamferMenu.Run();
            Check.That(Debug.logged.Last().Contains("12 edges full"), Debug.logged.Last());
        }

        public static void Every_menu_entry_has_a_validator()
        {
            var items = typeof(ChamferMenu).GetMethods(BindingFlags.Static | BindingFlags.NonPublic | BindingFlags.Public)
                .SelectMany(method => method.GetCustomAttributes(typeof(MenuItem), false).Cast<MenuItem>()).ToList();
            Check.Equal(3, items.Count(item => !item.isValidator));
            Check.That(items.GroupBy(item => item.path).All(entry => entry.Any(item => item.isValidator)), "validators");
        }

        /// Unity calls an entry of the GameObject menu once for each selected object, in any order.
        public static void The_menu_of_objects_runs_once()
        {
            var entry = typeof(ChamferMenu).GetMethod("RunFromGameObject", BindingFlags.Static | BindingFlags.NonPublic);
            for (int time = 0; time < 2; time++)
            {
                Mesh shared;
                var root = Scene.Hierarchy(out shared);
                var selected = new Object[] { shared, root, root.children[0] };
                Selection.objects = selected;
                int logged = Debug.logged.Count;
                var called = time == 0 ? selected.Skip(1) : selected.Skip(1).Reverse();
                foreach (var item in called) { entry.Invoke(null, new object[] { new MenuCommand { context = item } }); }
                EditorApplication.Idle();
                Check.Equal(1, Debug.logged.Count - logged);
                Check.That(Scene.MeshOf(root) != shared, "chamfered");
            }
        }

        public static void Imported_models_are_not_selectable()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            Scene.MakeAsset(root, "Assets/Model.fbx");
            Check.That(new ChamferSelection(new[] { root }).IsEmpty, "models cannot be changed");
        }

        public static void Prefabs_of_installed_packages_are_not_selectable()
        {
            var prefab = Scene.Holding(Shapes.Cube(), "Locked");
            Scene.MakeAsset(prefab, "Packages/com.other/Locked.prefab");
            Check.That(new ChamferSelection(new[] { prefab }).IsEmpty, "packages cannot be changed");
        }

        public static void A_selected_mesh_asset_gets_a_file_beside_it()
        {
            var mesh = Shapes.Cube();
            AssetDatabase.paths[mesh] = "Assets/Beside/Cube.asset";
            ChamferAll(mesh);
            var saved = AssetDatabase.LoadAssetAtPath<Mesh>("Assets/Beside/Cube Chamfered.asset");
            Check.Equal(44 * 3, saved.GetTriangles(0).Length);
            ChamferAll(mesh);
            Check.That(AssetDatabase.LoadAssetAtPath<Mesh>("Assets/Beside/Cube Chamfered.asset") == saved, "the same file again");
            Check.Equal(1, Scene.FilesIn("Assets/Beside/").Count(path => path.StartsWith("Assets/Beside/Cube Chamfered")));
        }

        public static void Meshes_of_prefabs_go_into_their_file()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            Scene.MakeAsset(root, "Assets/Crate.prefab");
            ChamferAll(root);
            Check.Equal("Assets/Crate.prefab", AssetDatabase.GetAssetPath(Scene.MeshOf(root)));
            Check.Equal(2, Scene.MeshesIn("Assets/Crate.prefab").Count);
        }

        /// A prefab would lose a mesh that only the scene has.
        public static void A_mesh_that_a_prefab_and_a_scene_share_goes_into_the_prefab()
        {
            var shared = Shapes.Cube();
            GameObject item = Scene.Holding(shared, "Item"), prefab = Scene.Holding(shared, "Prefab");
            Scene.MakeAsset(prefab, "Assets/Shared.prefab");
            ChamferAll(item, prefab);
            Check.That(Scene.MeshOf(item) == Scene.MeshOf(prefab), "one for both");
            Check.Equal("Assets/Shared.prefab", AssetDatabase.GetAssetPath(Scene.MeshOf(item)));
        }

        public static void What_uses_a_mesh_asset_gets_the_chamfered_file()
        {
            var mesh = Shapes.Cube();
            AssetDatabase.paths[mesh] = "Assets/Used/Cube.asset";
            var prefab = Scene.Holding(mesh, "Prefab");
            Scene.MakeAsset(prefab, "Assets/Used/Prefab.prefab");
            ChamferAll(prefab, mesh);
            Check.Equal("Assets/Used/Cube Chamfered.asset", AssetDatabase.GetAssetPath(Scene.MeshOf(prefab)));
            Check.Equal(0, Scene.MeshesIn("Assets/Used/Prefab.prefab").Count);
        }

        /// A variant's components are an instance of its base, in a file of its own.
        public static void Prefab_variants_override_and_keep_their_own_mesh()
        {
            var variant = Scene.Holding(Shapes.Cube(), "Variant");
            var holder = variant.GetComponents<MeshFilter>()[0];
            Scene.MakeAsset(variant, "Assets/Variant.prefab");
            PrefabUtility.instances.Add(holder);
            ChamferAll(variant);
            Check.Equal("Assets/Variant.prefab", AssetDatabase.GetAssetPath(holder.sharedMesh));
            Check.That(PrefabUtility.modified.Contains(holder), "override");
        }
    }
}
