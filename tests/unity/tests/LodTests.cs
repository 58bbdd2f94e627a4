// The source far away, where chamfers are narrower than a pixel.
using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class LodTests
    {
        private static ChamferModifier Chamfered(GameObject item)
        {
            var modifier = item.AddComponent<ChamferModifier>();
            modifier.includeChildren = true;
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            return modifier;
        }

        private static string Heights(GameObject item)
        {
            return string.Join(" ", item.GetComponent<LODGroup>().GetLODs().Select(level => level.screenRelativeTransitionHeight.ToString("0.00", System.Globalization.CultureInfo.InvariantCulture)));
        }

        public static void One_click_makes_a_group()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            var modifier = Chamfered(root);
            Check.Equal(null, ModifierLods.Make(modifier));
            var levels = root.GetComponent<LODGroup>().GetLODs();
            Check.That(levels[0].renderers.SequenceEqual(new Renderer[] { root.GetComponent<MeshRenderer>(), root.children[0].GetComponent<MeshRenderer>(), root.children[0].children[0].GetComponent<SkinnedMeshRenderer>() }), "near");
            Check.Equal(3, levels[1].renderers.Length);
            Check.Equal("0.19 0.01", Heights(root));
            Check.That(levels[1].renderers[0].GetComponent<MeshFilter>().sharedMesh == shared, "the source");
            Check.That(levels[1].renderers[2] is SkinnedMeshRenderer, "with its bones");
            Check.Equal("Wood", levels[1].renderers[0].sharedMaterials.Single().name);
            Undo.PerformUndo();
            Check.Equal(0, root.GetComponents<LODGroup>().Length);
            Check.Equal(3, MeshSlot.In(root, true).Count);
        }

        public static void Materials_of_chamfers_are_for_close_by()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            var modifier = root.AddComponent<ChamferModifier>();
            modifier.settings.submeshMode = ChamferSubmesh.Own;
            ModifierActions.Chamfer(modifier);
            ModifierLods.Make(modifier);
            var levels = root.GetComponent<LODGroup>().GetLODs();
            Check.Equal(2, levels[0].renderers[0].sharedMaterials.Length);
            Check.Equal(1, levels[1].renderers[0].sharedMaterials.Length);
        }

        public static void A_source_far_away_is_not_chamfered()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            var modifier = Chamfered(root);
            ModifierLods.Make(modifier);
            ModifierActions.Chamfer(modifier);
            Check.Equal(1, modifier.meshes.Count);
            Check.That(new ChamferSelection(new[] { root }).Chamfer(ChamferSettings.Default).ToString().EndsWith("; 1 mesh chamfered already left alone"), "nor by the menu");
            Undo.Click();
            ModifierLods.Make(modifier);
            Check.Equal(2, MeshSlot.In(root, true).Count);
        }

        public static void Reverting_takes_the_levels_away()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            var modifier = Chamfered(root);
            ModifierLods.Make(modifier);
            Undo.Click();
            ModifierActions.Revert(modifier);
            Check.Equal(0, root.GetComponents<LODGroup>().Length);
            Check.Equal(1, MeshSlot.In(root, true).Count);
            Undo.PerformUndo();
            Check.Equal(2, root.GetComponent<LODGroup>().GetLODs().Length);
        }

        public static void A_group_that_is_there_gets_a_level()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            var coarse = Scene.Holding(Shapes.Cube(), "Coarse");
            var group = root.AddComponent<LODGroup>();
            group.SetLODs(new[] { new LOD(0.05f, new Renderer[] { root.GetComponent<MeshRenderer>() }), new LOD(0.02f, new Renderer[] { coarse.GetComponent<MeshRenderer>() }) });
            var modifier = Chamfered(root);
            ModifierLods.Make(modifier);
            Check.Equal("0.19 0.05 0.02", Heights(root));
            Undo.Click();
            ModifierActions.Revert(modifier);
            Check.Equal("0.05 0.02", Heights(root));
            Undo.PerformUndo();
            Check.Equal("0.19 0.05 0.02", Heights(root));
            group.SetLODs(new[] { new LOD(0.6f, new Renderer[] { root.GetComponent<MeshRenderer>() }), new LOD(0.02f, new Renderer[] { coarse.GetComponent<MeshRenderer>() }) });
            modifier.farObjects.Clear();
            ModifierLods.Make(modifier);
            Check.Equal("0.80 0.60 0.02", Heights(root));
        }

        public static void The_inspector_has_a_button()
        {
            var modifier = Chamfered(Scene.Holding(Shapes.Cube(), "Root"));
            var inspector = new ModifierInspector { target = modifier, targets = new Object[] { modifier }, serializedObject = new SerializedObject(modifier) };
            GUILayout.broken = false;
            GUILayout.clicked = "Make LOD";
            try { Check.Throws<ExitGUIException>(inspector.OnInspectorGUI); }
            finally { GUILayout.clicked = null; }
            Check.Equal(1, modifier.farObjects.Count);
        }

        public static void Narrow_chamfers_are_for_close_by()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            var modifier = root.AddComponent<ChamferModifier>();
            modifier.settings.unit = WidthUnit.MeshUnits;
            modifier.settings.width = 0.01f;
            ModifierActions.Chamfer(modifier);
            Check.Near(2 / 0.01f / 1080, LodHeight.Of(modifier));
            modifier.settings.width = 0.0001f;
            ModifierActions.Chamfer(modifier);
            Check.Near(0.5f, LodHeight.Of(modifier));
        }

        public static void What_cannot_have_levels_says_why()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            Check.Equal("Chamfer the object first", ModifierLods.Make(root.AddComponent<ChamferModifier>()));
            var prefab = Scene.Holding(Shapes.Cube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/Lod.prefab");
            Check.Equal("Open the prefab to give it levels of detail", ModifierLods.Make(Chamfered(prefab)));
        }
    }
}
