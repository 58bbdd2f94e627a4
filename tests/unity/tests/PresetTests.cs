// Settings that many share.
using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class PresetTests
    {
        private static ChamferPreset Preset(string path, float width)
        {
            var preset = ScriptableObject.CreateInstance<ChamferPreset>();
            preset.settings.width = width;
            AssetDatabase.paths[preset] = path;
            return preset;
        }

        private static float WidthOf(GameObject item)
        {
            return 1 - Scene.MeshOf(item).vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y)));
        }

        public static void A_modifier_follows_its_preset()
        {
            var preset = Preset("Assets/Fine.asset", 2);
            var modifier = Scene.Holding(Shapes.Cube(), "Item").AddComponent<ChamferModifier>();
            modifier.Preset = preset;
            ModifierActions.Chamfer(modifier);
            Check.Near(0.04f, WidthOf(modifier.gameObject));
            Check.That(!ModifierState.IsOutdated(modifier), "as it should be");
            Undo.Click();
            var settings = preset.Settings;
            settings.width = 5;
            preset.Settings = settings;
            Check.That(ModifierState.IsOutdated(modifier), "out of date");
            new ChamferSelection(new[] { modifier.gameObject }).Chamfer(ChamferSettings.Default);
            Check.Near(0.1f, WidthOf(modifier.gameObject));
            modifier.preset.settings.width = 4;
            modifier.preset.settings.verify = VerifyMode.Seen;
            ModifierActions.Preview(modifier);
            Check.Near(0.08f, WidthOf(modifier.gameObject));
            Check.That(!ModifierState.IsOutdated(modifier), "a preview does");
            Check.That(ReportText.Of(modifier).EndsWith("press Chamfer"), "and says so");
        }

        /// Whoever imports may not have the preset yet.
        public static void Rules_keep_the_values_of_their_presets()
        {
            var project = ChamferProjectSettings.instance;
            var preset = Preset("Assets/Rule.asset", 2);
            project.rules.Add(new ModelRule { folder = "Assets/Preset", preset = preset });
            project.preset = preset;
            try
            {
                project.Write();
                Check.Equal(2f, ChamferProjectSettings.Load().rules[0].settings.width);
                Check.Equal(2f, ChamferProjectSettings.Load().settings.width);
                preset.settings.width = 3;
                Project.postprocessors.AddRange(new[] { typeof(ModelChamfer), typeof(ImportChanges) });
                Project.AddModel("Assets/Preset/a.fbx", () => Scene.Holding(Shapes.Cube(), "Model"));
                AssetDatabase.imported.Clear();
                Check.That(PresetSync.Follow(new[] { "Assets/Rule.asset" }), "changed");
                Check.That(!PresetSync.Follow(new[] { "Assets/Rule.asset", "Assets/Preset/a.fbx" }), "once");
                Check.Equal(3f, ChamferProjectSettings.Load().rules[0].settings.width);
                preset.settings.width = 4;
                Project.TellImported("Assets/Rule.asset");
                EditorApplication.Idle();
                Check.That(AssetDatabase.imported.Contains("together: Assets/Preset/a.fbx"), "imported again");
                Check.Equal(4f, AssetDatabase.LoadAssetAtPath<ChamferRecord>("Assets/Preset/a.fbx").settings.width);
            }
            finally
            {
                Project.postprocessors.Clear();
                project.rules.Clear();
                project.preset = null;
                project.settings = ChamferProjectSettings.Usual();
                project.Write();
            }
        }

        public static void Batches_take_a_preset()
        {
            var prefab = Scene.Holding(Shapes.Cube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/PresetBatch/Prefab.prefab");
            Preset("Assets/Batch.asset", 5);
            Check.Equal(2, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/PresetBatch", "-chamferPreset", "Assets/None.asset" }));
            Check.Equal(0, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/PresetBatch", "-chamferPreset", "Assets/Batch.asset" }));
            Check.Near(0.1f, WidthOf(prefab));
        }

        /// Where the points of a cube go one of whose corners leans far inwards.
        static string Leaning(string how)
        {
            var settings = ChamferSettings.Default;
            settings.width = 40;
            settings.segments = 2;
            settings.evenness = how == "even" ? 1 : how == "free" ? 1e-9f : 0;
            settings.profile = how == "sharp" ? 1 : how == "flat" ? 1e-9f : 0;
            var cube = Shapes.Cube();
            float farthest = cube.vertices.Max(p => p.x + p.y + p.z);
            cube.vertices = cube.vertices.Select(p => p.x + p.y + p.z == farthest ? p * 0.2f : p).ToArray();
            return string.Join(" ", MeshChamfer.Run(cube, settings).Mesh.vertices.Select(p => p.x + "," + p.y + "," + p.z));
        }

        public static void Every_option_of_the_library_is_a_setting()
        {
            var settings = ChamferSettings.Default;
            settings.width = 30;
            var usual = MeshChamfer.Run(Shapes.Cube(), settings).Report.MeanWidth;
            settings.leastBreadth = 0.8f;
            Check.That(MeshChamfer.Run(Shapes.Cube(), settings).Report.MeanWidth < usual, "less room");
            Check.That(SettingsText.Of(settings) != SettingsText.Of(ChamferSettings.Default), "told apart");
            var even = ChamferSettings.Default;
            even.evenness = 1;
            Check.That(SettingsText.Of(even) != SettingsText.Of(ChamferSettings.Default), "told apart");
            even.evenness = 2;
            Check.Throws<ChamferException>(() => MeshChamfer.Run(Shapes.Cube(), even));
            Check.Equal(5, new[] { "", "even", "free", "sharp", "flat" }.Select(Leaning).Distinct().Count());
        }
    }
}
