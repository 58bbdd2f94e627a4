using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Chamfer;
using Chamfer.Streams;
using ChamferEditor;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class ImportTests
    {
        private static bool Find(string path, string label, out ChamferSettings settings)
        {
            var folder = new FolderRule { folder = "Assets/Props/", settings = ChamferSettings.Default };
            var nearer = folder;
            nearer.folder = "Assets/Props/Fine";
            nearer.settings.width = 0.25f;
            var labels = label == null ? new string[0] : new[] { "Other", label };
            return ImportRule.TryFind(path, labels, ChamferSettings.Default, new[] { nearer, folder }, out settings);
        }

        public static void Labels_and_folders_switch_chamfering_on()
        {
            ChamferSettings settings;
            Check.That(!Find("Assets/a.fbx", null, out settings), "off by default");
            Check.That(!Find("Assets/PropsElse/a.fbx", null, out settings), "another folder");
            Check.That(!Find("Assets/a.fbx", "ChamferNot", out settings), "another label");
            Check.That(Find("Assets/a.fbx", "Chamfer", out settings) && settings.width == 1, "label");
            Check.That(Find("Assets/a.fbx", "chamfer=0.02", out settings), "width");
            Check.That(settings.width == 0.02f && settings.unit == WidthUnit.MeshUnits, "mesh units");
            Check.That(Find("Assets/a.fbx", "Chamfer=2%", out settings), "percent");
            Check.That(settings.width == 2 && settings.unit == WidthUnit.PercentOfExtent, "percent");
            Check.That(Find("Assets/Props/a.fbx", null, out settings) && settings.width == 1, "folder");
            Check.That(Find("Assets/Props/Fine/a.fbx", null, out settings) && settings.width == 0.25f, "nearer folder");
        }

        public static void A_folder_without_a_width_takes_the_common_settings()
        {
            ChamferSettings settings;
            var rules = new[] { new FolderRule { folder = "Assets/New" } };
            Check.That(ImportRule.TryFind("Assets/New/a.fbx", new string[0], ChamferSettings.Default, rules, out settings), "on");
            Check.Equal(ChamferSettings.Default, settings);
        }

        private static AssetImportContext Import(Mesh mesh, params string[] labels)
        {
            return Import(Scene.Holding(mesh, "Model"), labels);
        }

        private static AssetImportContext Import(GameObject root, params string[] labels)
        {
            AssetDatabase.labels["Assets/model.fbx"] = labels;
            var context = new AssetImportContext();
            var importer = new ModelChamfer { assetPath = "Assets/model.fbx", context = context };
            var hook = typeof(ModelChamfer).GetMethod("OnPostprocessModel", BindingFlags.Instance | BindingFlags.NonPublic);
            hook.Invoke(importer, new object[] { root });
            return context;
        }

        public static void Importing_replaces_what_the_mesh_holds()
        {
            var mesh = Shapes.FullCube();
            Check.Equal(0, Import(mesh, "Chamfer=0.1").warnings.Count);
            Check.Equal(44 * 3, mesh.GetTriangles(0).Length);
            Check.Equal(2, mesh.blendShapeCount);
            Check.Equal(2, mesh.bindposes.Length);
        }

        public static void A_submesh_of_their_own_is_imported_with_a_material()
        {
            var mesh = Shapes.Cube();
            GameObject first = Scene.Holding(mesh, "First"), second = Scene.Holding(mesh, "Second");
            first.children.Add(second);
            var project = ChamferProjectSettings.instance;
            project.settings.submeshMode = ChamferSubmesh.Own;
            try { Import(first, "Chamfer"); }
            finally { project.settings.submeshMode = ChamferSubmesh.Owner; }
            Check.Equal(2, mesh.subMeshCount);
            foreach (var renderer in first.GetComponentsInChildren<Renderer>(true)) { Check.Equal(2, renderer.sharedMaterials.Length); }
        }

        public static void Importing_without_a_label_changes_nothing()
        {
            var mesh = Shapes.Cube();
            Import(mesh);
            Check.Equal(36, mesh.GetTriangles(0).Length);
        }

        public static void Failures_are_warnings()
        {
            var mesh = Shapes.Cube();
            mesh.normals = new Vector3[0];
            Check.That(Import(mesh, "Chamfer").warnings.Single().Contains("normals"), "no normals");
            Check.That(Import(Shapes.Cube(), "Chamfer=wide").warnings.Single().Contains("Chamfer=0.02"), "bad label");
        }

        public static void Chamfered_models_depend_on_the_project_settings()
        {
            Check.Equal(ImportDependency.Name, Import(Shapes.Cube(), "Chamfer").dependencies.Single());
            Check.Equal(0, Import(Shapes.Cube()).dependencies.Count);
        }

        public static void Another_setting_is_another_dependency()
        {
            var project = ChamferProjectSettings.instance;
            var folder = new FolderRule { folder = "Assets/Rule/", settings = ChamferSettings.Default };
            AssetDatabase.paths[new GameObject("Barrel")] = "Assets/Rule/barrel.fbx";
            ImportDependency.Register();
            var before = AssetDatabase.dependencies[ImportDependency.Name];
            Check.Equal(3, LibraryCheck.Version().Split('.').Length);
            Check.That(before.text.StartsWith(LibraryCheck.Version() + "\n"), "the library's version");
            ImportDependency.Register();
            Check.Equal(before, AssetDatabase.dependencies[ImportDependency.Name]);
            project.folders.Add(folder);
            try { ImportDependency.ImportAgain(); }
            finally { project.folders.Clear(); }
            Check.That(!before.Equals(AssetDatabase.dependencies[ImportDependency.Name]), "another hash");
            Check.Equal("Assets/Rule/barrel.fbx", AssetDatabase.imported.Last());
        }

        public static void Labels_are_written_as_they_are_read()
        {
            var settings = ChamferSettings.Default;
            settings.width = 0.1f;
            Check.Equal("Chamfer=0.1%", ImportRule.LabelOf(settings));
            settings.unit = WidthUnit.MeshUnits;
            ChamferSettings read;
            Check.That(Find("Assets/a.fbx", ImportRule.LabelOf(settings), out read), "label");
            Check.That(read.width == settings.width && read.unit == settings.unit, "the same width");
        }
    }
}
