// Whose a mesh is: objects are duplicated, nested, and chamfered again and again.
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class OwnershipTests
    {
        private static ChamferModifier Chamfered(GameObject item, float width = 1)
        {
            var modifier = item.AddComponent<ChamferModifier>();
            modifier.settings.width = width;
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            return modifier;
        }

        private static void Widen(ChamferModifier modifier, float width)
        {
            modifier.settings.width = width;
            ModifierActions.Chamfer(modifier);
        }

        /// How far the chamfers of a cube reach.
        private static float WidthOf(Mesh cube)
        {
            return 1 - cube.vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y)));
        }

        public static void Copies_in_a_scene_do_not_follow_each_other()
        {
            foreach (bool sameStep in new[] { false, true })
            {
                var first = Chamfered(Scene.Holding(Shapes.Cube(), "Crate"));
                var copy = first.gameObject.Duplicate();
                if (!sameStep) { Undo.Click(); }
                Widen(first, 5);
                Check.Near(0.02f, WidthOf(Scene.MeshOf(copy)));
                Check.Near(0.1f, WidthOf(Scene.MeshOf(first.gameObject)));
                Undo.Click();
                ModifierActions.Revert(copy.GetComponent<ChamferModifier>());
                Check.Near(0.1f, WidthOf(Scene.MeshOf(first.gameObject)));
                Check.That(Scene.MeshOf(copy) == first.meshes[0].original, "the original");
            }
        }

        /// A drag writes one mesh again and again, until somebody else uses it.
        public static void A_copy_that_is_made_during_a_drag_keeps_its_mesh()
        {
            var first = Chamfered(Scene.Holding(Shapes.Cube(), "Crate"));
            Widen(first, 2);
            var copy = first.gameObject.Duplicate();
            Widen(first, 5);
            Check.Near(0.04f, WidthOf(Scene.MeshOf(copy)));
        }

        public static void Copies_in_a_prefab_do_not_follow_each_other()
        {
            var root = new GameObject("Pallet");
            var crate = Scene.Holding(Shapes.Cube(), "Crate");
            root.children.Add(crate);
            Scene.MakeAsset(root, "Assets/Pallet.prefab");
            var first = Chamfered(crate);
            var copy = crate.Duplicate();
            root.children.Add(copy);
            Scene.MakeAsset(copy, "Assets/Pallet.prefab");
            Undo.Click();
            Widen(first, 5);
            Check.Near(0.02f, WidthOf(Scene.MeshOf(copy)));
            Check.Equal(2, Scene.MeshesIn("Assets/Pallet.prefab").Count);
            Undo.Click();
            ModifierActions.Revert(first);
            Check.That(Scene.MeshOf(copy) != null, "the other keeps its mesh");
            Undo.Click();
            ModifierActions.Revert(copy.GetComponent<ChamferModifier>());
            Check.Equal(0, Scene.MeshesIn("Assets/Pallet.prefab").Count);
        }

        public static void A_collider_keeps_the_mesh_that_it_uses()
        {
            var modifier = Chamfered(Scene.Holding(Shapes.Cube(), "Crate"));
            var mesh = Scene.MeshOf(modifier.gameObject);
            modifier.gameObject.AddComponent<MeshCollider>().sharedMesh = mesh;
            Widen(modifier, 5);
            Check.That(mesh != null && Scene.MeshOf(modifier.gameObject) != mesh, "kept");
            Check.Near(0.02f, WidthOf(mesh));
            var other = Scene.Holding(mesh, "Other");
            Undo.Click();
            ModifierActions.Revert(modifier);
            Check.That(Scene.MeshOf(other) != null, "and so does any object");
        }

        public static void A_skinned_renderer_keeps_the_mesh_that_it_uses()
        {
            var modifier = Chamfered(Scene.Holding(Shapes.Cube(), "Crate"));
            var mesh = Scene.MeshOf(modifier.gameObject);
            new GameObject("Other").AddComponent<SkinnedMeshRenderer>().sharedMesh = mesh;
            ModifierActions.Revert(modifier);
            Check.That(mesh != null, "kept");
        }

        public static void Instances_of_a_prefab_keep_no_mesh_from_being_written()
        {
            var crate = Scene.Holding(Shapes.Cube(), "Crate");
            Scene.MakeAsset(crate, "Assets/Instanced.prefab");
            var modifier = Chamfered(crate);
            var instance = (GameObject)PrefabUtility.InstantiatePrefab(crate);
            Widen(modifier, 5);
            Check.Equal(1, Scene.MeshesIn("Assets/Instanced.prefab").Count);
            Check.Near(0.1f, WidthOf(Scene.MeshOf(instance)));
        }

        /// Each drag is a step of its own, with many previews.
        public static void Ten_drags_leave_no_meshes_behind()
        {
            var modifier = Chamfered(Scene.Holding(Shapes.Cube(), "Crate"));
            var first = Scene.MeshOf(modifier.gameObject);
            Object.everMade = new List<Object>();
            try
            {
                for (int drag = 0; drag < 10; drag++)
                {
                    for (int step = 0; step < 5; step++) { Widen(modifier, 1 + drag + 0.1f * step); }
                    Undo.Click();
                }
                Check.Equal(1, Object.everMade.Count(made => made is Mesh && made != null));
            }
            finally { Object.everMade = null; }
            for (int drag = 0; drag < 10; drag++) { Undo.PerformUndo(); }
            Check.That(first != null && Scene.MeshOf(modifier.gameObject) == first, "undo brings them back");
        }

        public static void A_child_with_a_modifier_is_its_own()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            var child = Chamfered(root.children[0], 5);
            var parent = root.AddComponent<ChamferModifier>();
            parent.includeChildren = true;
            ModifierActions.Chamfer(parent);
            Check.Near(0.1f, WidthOf(Scene.MeshOf(root.children[0])));
            Check.Equal(2, parent.meshes.Count);
            child.includeChildren = true;
            Check.Equal(1, ModifierSlots.Of(parent).Count);
        }

        public static void Reverting_in_any_order_gives_the_originals_back()
        {
            foreach (bool childFirst in new[] { false, true })
            {
                Mesh shared;
                var root = Scene.Hierarchy(out shared);
                var parent = root.AddComponent<ChamferModifier>();
                parent.includeChildren = true;
                ModifierActions.Chamfer(parent);
                Undo.Click();
                var child = Chamfered(root.children[0], 5);
                Check.That(child.meshes.Single().original == shared, "the original, not the parent's result");
                Check.Equal(2, parent.meshes.Count);
                foreach (var modifier in childFirst ? new[] { child, parent } : new[] { parent, child })
                {
                    ModifierActions.Revert(modifier);
                    Undo.Click();
                }
                Check.That(Scene.MeshOf(root) == shared && Scene.MeshOf(root.children[0]) == shared, "originals");
            }
        }

        public static void What_another_modifier_gave_up_is_given_back_by_undo()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            var parent = root.AddComponent<ChamferModifier>();
            parent.includeChildren = true;
            ModifierActions.Chamfer(parent);
            var before = Scene.MeshOf(root.children[0]);
            Undo.Click();
            Chamfered(root.children[0], 5);
            Undo.PerformUndo();
            Check.That(Scene.MeshOf(root.children[0]) == before && parent.meshes.Count == 3, "as before");
        }

        /// A hundred crates, one mesh.
        public static void Objects_with_the_same_source_and_settings_share_one_mesh()
        {
            var cube = Shapes.Cube();
            var modifiers = Enumerable.Range(0, 100).Select(i => Scene.Holding(cube, "Crate").AddComponent<ChamferModifier>()).ToList();
            Undo.Click();
            Object.everMade = new List<Object>();
            try
            {
                for (int step = 1; step < 4; step++)
                {
                    foreach (var modifier in modifiers) { Widen(modifier, step); }
                    Check.Equal(1, modifiers.Select(modifier => Scene.MeshOf(modifier.gameObject)).Distinct().Count());
                    Check.Equal(1, Object.everMade.Count(made => made is Mesh && made != null));
                }
            }
            finally { Object.everMade = null; }
            Undo.Click();
            Widen(modifiers[7], 5);
            Check.Near(0.06f, WidthOf(Scene.MeshOf(modifiers[8].gameObject)));
            Check.Near(0.1f, WidthOf(Scene.MeshOf(modifiers[7].gameObject)));
        }

        public static void What_stands_otherwise_or_elsewhere_shares_nothing()
        {
            GameObject first = Scene.Resting(2), second = Scene.Resting(2.5f);
            second.GetComponent<MeshFilter>().sharedMesh = Scene.MeshOf(first);
            second.children[0].GetComponent<MeshFilter>().sharedMesh = Scene.MeshOf(first.children[0]);
            foreach (var root in new[] { first, second })
            {
                root.AddComponent<ChamferModifier>().includeChildren = true;
                ModifierActions.Chamfer(root.GetComponent<ChamferModifier>());
            }
            Check.That(Scene.KeepsEdges(Scene.MeshOf(first)) && !Scene.KeepsEdges(Scene.MeshOf(second)), "each as it stands");
            var cube = Shapes.Cube();
            GameObject here = Scene.Holding(cube, "Here"), there = Scene.Holding(cube, "There");
            there.scene = new UnityEngine.SceneManagement.Scene { name = "Other" };
            Check.That(Chamfered(here).meshes[0].chamfered != Chamfered(there).meshes[0].chamfered, "each scene keeps its own");
        }

        public static void The_menu_shares_with_what_was_chamfered_before()
        {
            var cube = Shapes.Cube();
            GameObject first = Scene.Holding(cube, "First"), second = Scene.Holding(cube, "Second");
            foreach (var item in new[] { first, second })
            {
                new ChamferSelection(new[] { item }).Chamfer(ChamferSettings.Default);
                Undo.Click();
            }
            Check.That(Scene.MeshOf(first) == Scene.MeshOf(second), "shared");
        }
    }
}
