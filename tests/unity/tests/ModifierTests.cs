using System.Collections;
using System.Linq;
using System.Reflection;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class ModifierTests
    {
        private static ChamferModifier Modifier(out Mesh original)
        {
            var root = Scene.Hierarchy(out original);
            return root.AddComponent<ChamferModifier>();
        }

        public static void It_chamfers_and_reverts()
        {
            Mesh original;
            var modifier = Modifier(out original);
            Check.Equal(0, ModifierActions.Chamfer(modifier).Count);
            Check.That(modifier.IsApplied && Scene.MeshOf(modifier.gameObject) != original, "chamfered");
            Check.That(Scene.MeshOf(modifier.gameObject.children[0]) == original, "children are left out");
            ModifierActions.Revert(modifier);
            Check.That(!modifier.IsApplied && Scene.MeshOf(modifier.gameObject) == original, "reverted");
        }

        public static void Each_step_can_be_undone()
        {
            Mesh original;
            var modifier = Modifier(out original);
            ModifierActions.Chamfer(modifier);
            var narrow = Scene.MeshOf(modifier.gameObject);
            Undo.Click();
            modifier.settings.width = 5;
            ModifierActions.Chamfer(modifier);
            Check.That(Scene.MeshOf(modifier.gameObject) != narrow, "a mesh of its own for each step");
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(modifier.gameObject) == narrow && modifier.meshes[0].chamfered == narrow, "narrow again");
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(modifier.gameObject) == original && !modifier.IsApplied, "original again");
            Check.That(narrow == null, "what was made is gone");
        }

        /// A drag is one undo step with many changes of the width.
        public static void A_preview_leaves_no_meshes_behind()
        {
            Mesh original;
            var modifier = Modifier(out original);
            modifier.includeChildren = true;
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            ModifierActions.Chamfer(modifier);
            var first = Scene.MeshOf(modifier.gameObject);
            for (int width = 2; width < 20; width++)
            {
                modifier.settings.width = width;
                ModifierActions.Chamfer(modifier);
                Check.That(Scene.MeshOf(modifier.gameObject) == first, "one mesh for the whole drag");
            }
            Check.Near(1 - 0.38f, first.vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
        }

        public static void Chamfering_again_begins_with_the_original()
        {
            Mesh original;
            var modifier = Modifier(out original);
            modifier.includeChildren = true;
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            modifier.settings.width = 5;
            ModifierActions.Chamfer(modifier);
            Check.Equal(3, modifier.meshes.Count);
            Check.Equal(12, VerdictCache.Of(modifier.meshes[0]).Report.HardEdges);
            Check.That(modifier.meshes[0].original == original, "original");
            Check.That(modifier.meshes[0].chamfered == modifier.meshes[1].chamfered, "shared");
            modifier.includeChildren = false;
            ModifierActions.Chamfer(modifier);
            Check.That(Scene.MeshOf(modifier.gameObject.children[0]) == original, "a child that is left out is reverted");
        }

        public static void Several_modifiers_keep_their_own_settings()
        {
            Mesh original;
            var wide = Modifier(out original);
            var narrow = wide.gameObject.children[0].AddComponent<ChamferModifier>();
            wide.settings.width = 5;
            ModifierActions.Chamfer(wide);
            ModifierActions.Chamfer(narrow);
            Check.That(Scene.MeshOf(wide.gameObject) != Scene.MeshOf(narrow.gameObject), "own meshes");
            Check.Near(0.1f, VerdictCache.Of(wide.meshes[0]).Report.Width);
            Check.Near(0.01f, VerdictCache.Of(narrow.meshes[0]).Report.Width);
        }

        public static void A_mesh_that_someone_else_set_is_theirs()
        {
            Mesh original;
            var modifier = Modifier(out original);
            ModifierActions.Chamfer(modifier);
            var theirs = Shapes.Cube();
            modifier.gameObject.GetComponents<MeshFilter>()[0].sharedMesh = theirs;
            ModifierActions.Revert(modifier);
            Check.That(Scene.MeshOf(modifier.gameObject) == theirs, "kept");
        }

        public static void Cancelling_keeps_what_it_had()
        {
            Mesh original;
            var modifier = Modifier(out original);
            var big = Shapes.Cubes(20000);
            modifier.gameObject.GetComponents<MeshFilter>()[0].sharedMesh = big;
            EditorUtility.onProgress = share => true;
            try { ModifierActions.Chamfer(modifier); }
            finally { EditorUtility.onProgress = share => false; }
            // It may be through before the bar appears.
            Check.That(modifier.IsApplied || Scene.MeshOf(modifier.gameObject) == big, "all or nothing");
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

        public static void A_prefab_holds_one_mesh_however_often_it_is_chamfered()
        {
            Mesh original;
            var modifier = Modifier(out original);
            Scene.MakeAsset(modifier.gameObject, "Assets/Box.prefab");
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            modifier.settings.width = 5;
            ModifierActions.Chamfer(modifier);
            Check.Equal(1, Scene.MeshesIn("Assets/Box.prefab").Count);
            var mesh = Scene.MeshOf(modifier.gameObject);
            float wide = mesh.vertices[0].y;
            Undo.PerformUndo();
            Check.That(mesh.vertices[0].y != wide, "undo brings back what the mesh held");
            Check.Near(0.01f, VerdictCache.Of(modifier.meshes[0]).Report.Width);
            Undo.Click();
            ModifierActions.Revert(modifier);
            Check.Equal(0, Scene.MeshesIn("Assets/Box.prefab").Count);
            Undo.PerformUndo();
            Check.That(mesh != null && Scene.MeshOf(modifier.gameObject) == mesh, "undo of the revert");
        }

        public static void Own_submeshes_get_a_material_and_give_it_back()
        {
            Mesh original;
            var modifier = Modifier(out original);
            var renderer = modifier.gameObject.GetComponents<Renderer>()[0];
            modifier.settings.submeshMode = ChamferSubmesh.Own;
            ModifierActions.Chamfer(modifier);
            ModifierActions.Chamfer(modifier);
            Check.Equal(2, renderer.sharedMaterials.Length);
            ModifierActions.Revert(modifier);
            Check.Equal(1, renderer.sharedMaterials.Length);
        }

        public static void Saved_meshes_become_files_that_stay()
        {
            Mesh original;
            var modifier = Modifier(out original);
            ModifierActions.Chamfer(modifier);
            var saved = Scene.MeshOf(modifier.gameObject);
            Check.Equal("Assets/Saved/Cube Chamfered.asset", ModifierActions.Save(modifier, "Assets/Saved").Single());
            Check.Equal(0, ModifierActions.Save(modifier, "Assets/Saved").Count);
            Undo.Click();
            ModifierActions.Chamfer(modifier);
            Check.That(Scene.MeshOf(modifier.gameObject) != saved && saved != null, "a new mesh, and the file as it was");
        }

        public static void The_report_names_reasons()
        {
            Mesh original;
            var modifier = Modifier(out original);
            modifier.settings.width = 200;
            ModifierActions.Chamfer(modifier);
            string text = ReportText.Of(modifier);
            Check.That(text.StartsWith("Cube: 24 -> 24 vertices, 12 -> 44 triangles; 12 hard edges, 0 full\n  12 narrowed: "), text);
            LoadScriptsAgain();
            Check.Equal(text, ReportText.Of(modifier));
        }

        /// Static fields begin anew then.
        private static void LoadScriptsAgain()
        {
            var known = typeof(VerdictCache).GetField("known", BindingFlags.Static | BindingFlags.NonPublic);
            ((IDictionary)known.GetValue(null)).Clear();
        }

        public static void Failures_are_told()
        {
            Mesh original;
            var modifier = Modifier(out original);
            original.normals = new Vector3[0];
            Check.That(ModifierActions.Chamfer(modifier).Single().Contains("normals"), "told");
            Check.That(!modifier.IsApplied && Scene.MeshOf(modifier.gameObject) == original, "left alone");
        }

        public static void The_overlay_draws_each_edge_once_also_of_unreadable_meshes()
        {
            Mesh original;
            var modifier = Modifier(out original);
            original.readable = false;
            ModifierActions.Chamfer(modifier);
            Handles.drawn.Clear();
            VerdictOverlay.Draw(modifier);
            Check.Equal(24, Handles.drawn[Color.green]);
            Check.Equal(0, Handles.drawn[Color.red]);
        }
    }
}
