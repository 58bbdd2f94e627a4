using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Chamfer;
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

        private static AssetImportContext Import(Mesh mesh, params string[] labels)
        {
            var root = new GameObject("Model");
            root.AddComponent<MeshFilter>().sharedMesh = mesh;
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

        public static void The_batch_chamfers_the_prefabs_of_a_folder()
        {
            var prefab = new GameObject("Crate");
            prefab.AddComponent<MeshFilter>().sharedMesh = Shapes.Cube();
            AssetDatabase.paths[prefab] = "Assets/Batch/Crate.prefab";
            Check.Equal(0, ChamferBatch.Run(new[] { "Unity", "-chamferFolder", "Assets/Batch", "-chamferWidth", "0.1" }));
            Check.Equal(44 * 3, prefab.GetComponents<MeshFilter>()[0].sharedMesh.GetTriangles(0).Length);
            var broken = Shapes.Cube();
            broken.normals = new Vector3[0];
            prefab.GetComponents<MeshFilter>()[0].sharedMesh = broken;
            Check.Equal(1, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/Batch" }));
        }

        public static void The_batch_refuses_bad_arguments()
        {
            Check.Equal(2, ChamferBatch.Run(new string[0]));
            Check.Equal(2, ChamferBatch.Run(new[] { "-chamferFolder", "Elsewhere" }));
            Check.Equal(2, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/Batch", "-chamferWidth", "wide" }));
        }
    }
}
