using System;
using System.Linq;
using System.Reflection;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class EditorTests
    {
        /// Two objects that share a cube, and below them a skinned one.
        private static GameObject Hierarchy(out Mesh shared)
        {
            shared = Shapes.Cube();
            var root = new GameObject("Root");
            root.AddComponent<MeshFilter>().sharedMesh = shared;
            var child = new GameObject("Child");
            child.AddComponent<MeshFilter>().sharedMesh = shared;
            var skinned = new GameObject("Skinned");
            skinned.AddComponent<SkinnedMeshRenderer>().sharedMesh = Shapes.FullCube();
            root.children.Add(child);
            child.children.Add(skinned);
            return root;
        }

        private static Mesh MeshOf(GameObject item) { return MeshSlot.In(item, false)[0].Mesh; }

        public static void The_menu_chamfers_a_hierarchy_and_shared_meshes_once()
        {
            Mesh shared;
            var root = Hierarchy(out shared);
            int created = Undo.created.Count, group = Undo.group;
            string summary = new ChamferSelection(new UnityEngine.Object[] { root, root.children[0] }).Chamfer(ChamferSettings.Default);
            Check.That(summary.StartsWith("2 meshes: 24 edges chamfered"), summary);
            Check.Equal(2, Undo.created.Count - created);
            Check.Equal(group + 1, Undo.collapsed);
            Check.That(MeshOf(root) != shared && MeshOf(root) == MeshOf(root.children[0]), "one new mesh for both");
            Check.Equal(12 * 3, shared.GetTriangles(0).Length);
            Check.That(!EditorUtility.barShown, "the bar is gone");
        }

        public static void Cancelling_the_menu_changes_nothing()
        {
            Mesh shared;
            var root = Hierarchy(out shared);
            int recorded = Undo.recorded.Count;
            EditorUtility.onProgress = share => share > 0.5f;
            try { Check.Equal(null, new ChamferSelection(new[] { root }).Chamfer(ChamferSettings.Default)); }
            finally { EditorUtility.onProgress = share => false; }
            Check.That(MeshOf(root) == shared, "mesh");
            Check.Equal(recorded, Undo.recorded.Count);
            Check.That(!EditorUtility.barShown, "the bar is gone");
        }

        public static void A_bad_mesh_is_told_and_the_others_are_chamfered()
        {
            Mesh shared;
            var root = Hierarchy(out shared);
            shared.normals = new Vector3[0];
            string summary = new ChamferSelection(new[] { root }).Chamfer(ChamferSettings.Default);
            Check.That(summary.StartsWith("1 meshes") && summary.Contains("'Cube'"), summary);
            Check.That(MeshOf(root) == shared, "left alone");
        }

        public static void Validators_look_at_the_selection()
        {
            Mesh shared;
            var root = Hierarchy(out shared);
            Selection.objects = new UnityEngine.Object[0];
            Check.That(!ChamferMenu.CanRun(), "nothing");
            Selection.objects = new UnityEngine.Object[] { new GameObject("Empty") };
            Check.That(!ChamferMenu.CanRun(), "no mesh");
            Selection.objects = new UnityEngine.Object[] { root };
            Check.That(ChamferMenu.CanRun(), "a hierarchy");
            Selection.objects = new UnityEngine.Object[] { shared };
            Check.That(ChamferMenu.CanRun(), "a mesh asset");
            ChamferMenu.Run();
            Check.That(Debug.logged.Last().Contains("12 edges chamfered"), Debug.logged.Last());
        }

        public static void Every_menu_entry_has_a_validator()
        {
            var items = typeof(ChamferMenu).GetMethods(BindingFlags.Static | BindingFlags.NonPublic | BindingFlags.Public)
                .SelectMany(method => method.GetCustomAttributes(typeof(MenuItem), false).Cast<MenuItem>()).ToList();
            Check.Equal(3, items.Count(item => !item.isValidator));
            Check.That(items.GroupBy(item => item.path).All(entry => entry.Any(item => item.isValidator)), "validators");
        }

        public static void Imported_models_are_not_selectable()
        {
            Mesh shared;
            var root = Hierarchy(out shared);
            foreach (var slot in MeshSlot.In(root, true))
            {
                EditorUtility.persistent.Add(slot.Holder);
                PrefabUtility.models.Add(slot.Holder);
            }
            Check.That(new ChamferSelection(new[] { root }).IsEmpty, "models cannot be changed");
        }

        public static void A_selected_mesh_asset_gets_a_file_beside_it()
        {
            var mesh = Shapes.Cube();
            AssetDatabase.paths[mesh] = "Assets/Props/Cube.asset";
            new ChamferSelection(new[] { mesh }).Chamfer(ChamferSettings.Default);
            Check.That(AssetDatabase.paths.ContainsValue("Assets/Props/Cube Chamfered.asset"), "file");
        }

        public static void Meshes_of_prefabs_go_into_their_file()
        {
            Mesh shared;
            var root = Hierarchy(out shared);
            var holder = root.GetComponents<MeshFilter>()[0];
            EditorUtility.persistent.Add(holder);
            AssetDatabase.paths[holder] = "Assets/Crate.prefab";
            new ChamferSelection(new[] { root }).Chamfer(ChamferSettings.Default);
            Check.Equal("Assets/Crate.prefab", AssetDatabase.GetAssetPath(holder.sharedMesh));
        }

        private static ChamferModifier Modifier(out Mesh original)
        {
            var root = Hierarchy(out original);
            return root.AddComponent<ChamferModifier>();
        }

        public static void The_modifier_chamfers_and_reverts()
        {
            Mesh original;
            var modifier = Modifier(out original);
            Check.Equal(0, ModifierActions.Chamfer(modifier).Count);
            Check.That(modifier.IsApplied && MeshOf(modifier.gameObject) != original, "chamfered");
            Check.That(Undo.recorded.Contains(modifier), "undo");
            Check.That(MeshOf(modifier.gameObject.children[0]) == original, "children are left out");
            ModifierActions.Revert(modifier);
            Check.That(!modifier.IsApplied && MeshOf(modifier.gameObject) == original, "reverted");
        }

        public static void Chamfering_again_begins_with_the_original()
        {
            Mesh original;
            var modifier = Modifier(out original);
            modifier.includeChildren = true;
            ModifierActions.Chamfer(modifier);
            modifier.settings.width = 5;
            ModifierActions.Chamfer(modifier);
            Check.Equal(3, modifier.meshes.Count);
            Check.Equal(12, modifier.meshes[0].report.HardEdges);
            Check.That(modifier.meshes[0].original == original, "original");
            Check.That(modifier.meshes[0].chamfered == modifier.meshes[1].chamfered, "shared");
            modifier.includeChildren = false;
            ModifierActions.Chamfer(modifier);
            Check.That(MeshOf(modifier.gameObject.children[0]) == original, "a child that is left out is reverted");
        }

        public static void A_mesh_that_someone_else_set_is_theirs()
        {
            Mesh original;
            var modifier = Modifier(out original);
            ModifierActions.Chamfer(modifier);
            var theirs = Shapes.Cube();
            modifier.gameObject.GetComponents<MeshFilter>()[0].sharedMesh = theirs;
            ModifierActions.Revert(modifier);
            Check.That(MeshOf(modifier.gameObject) == theirs, "kept");
        }

        public static void Cancelling_keeps_what_the_modifier_had()
        {
            Mesh original;
            var modifier = Modifier(out original);
            var big = Shapes.Cubes(20000);
            modifier.gameObject.GetComponents<MeshFilter>()[0].sharedMesh = big;
            EditorUtility.onProgress = share => true;
            try { ModifierActions.Chamfer(modifier); }
            finally { EditorUtility.onProgress = share => false; }
            // It may be through before the bar appears.
            Check.That(modifier.IsApplied || MeshOf(modifier.gameObject) == big, "all or nothing");
        }

        public static void Prefab_instances_record_their_overrides()
        {
            Mesh original;
            var modifier = Modifier(out original);
            var holder = modifier.gameObject.GetComponents<MeshFilter>()[0];
            PrefabUtility.instances.Add(holder);
            PrefabUtility.instances.Add(modifier);
            ModifierActions.Chamfer(modifier);
            Check.That(PrefabUtility.modified.Contains(holder) && PrefabUtility.modified.Contains(modifier), "recorded");
        }

        public static void Saved_meshes_become_files()
        {
            Mesh original;
            var modifier = Modifier(out original);
            ModifierActions.Chamfer(modifier);
            var paths = ModifierActions.Save(modifier, "Assets/Saved");
            Check.Equal("Assets/Saved/Cube Chamfered.asset", paths.Single());
            Check.Equal(0, ModifierActions.Save(modifier, "Assets/Saved").Count);
        }

        public static void The_report_names_reasons()
        {
            Mesh original;
            var modifier = Modifier(out original);
            modifier.settings.width = 200;
            ModifierActions.Chamfer(modifier);
            string text = ReportText.Of(modifier);
            Check.That(text.StartsWith("Cube: 24 -> 24 vertices, 12 -> 44 triangles; 12 hard edges, 0 at full width\n  12 narrowed: "), text);
        }

        public static void The_overlay_draws_each_edge_once()
        {
            var mesh = Shapes.Cube();
            var verdicts = MeshChamfer.Run(mesh, ChamferSettings.Default).Report.Verdicts;
            Check.Equal(24, VerdictOverlay.Segments(mesh.vertices, verdicts, EdgeOutcome.Full).Length);
            Check.Equal(0, VerdictOverlay.Segments(mesh.vertices, verdicts, EdgeOutcome.Skipped).Length);
        }
    }
}
