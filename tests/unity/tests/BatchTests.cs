using System.Linq;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class BatchTests
    {
        private static int Run(string folder, string width = "0.1")
        {
            return ChamferBatch.Run(new[] { "Unity", "-batchmode", "-chamferFolder", folder, "-chamferWidth", width });
        }

        public static void Prefabs_of_the_folder_are_chamfered()
        {
            var prefab = Scene.Holding(Shapes.Cube(), "Crate");
            Scene.MakeAsset(prefab, "Assets/Batch/Crate.prefab");
            Check.Equal(0, Run("Assets/Batch"));
            Check.Equal(44 * 3, Scene.MeshOf(prefab).GetTriangles(0).Length);
            Check.Equal("Assets/Batch/Crate.prefab", AssetDatabase.GetAssetPath(Scene.MeshOf(prefab)));
            var chamfered = Scene.MeshOf(prefab);
            Check.Equal(0, Run("Assets/Batch"));
            Check.That(Scene.MeshOf(prefab) == chamfered, "a second time changes nothing");
        }

        public static void Mesh_files_get_a_chamfered_one_beside()
        {
            var mesh = Shapes.Cube();
            AssetDatabase.paths[mesh] = "Assets/Meshes/Cube.asset";
            for (int time = 0; time < 2; time++)
            {
                Check.Equal(0, Run("Assets/Meshes"));
                Check.Equal(2, Scene.FilesIn("Assets/Meshes/").Count);
            }
            Check.Equal(12 * 3, mesh.GetTriangles(0).Length);
        }

        /// Even where an edge could still be chamfered.
        public static void Results_of_an_earlier_time_are_no_sources()
        {
            var mesh = Shapes.Cube();
            AssetDatabase.paths[mesh] = "Assets/Earlier/Cube Chamfered.asset";
            Check.Equal(0, Run("Assets/Earlier"));
            Check.Equal(12 * 3, mesh.GetTriangles(0).Length);
            Check.Equal(1, Scene.FilesIn("Assets/Earlier/").Count);
        }

        public static void Models_are_labelled_and_imported_again()
        {
            var mesh = Shapes.Cube();
            var model = Scene.Holding(mesh, "Model");
            Scene.MakeAsset(model, "Assets/Models/model.fbx");
            AssetDatabase.paths[mesh] = "Assets/Models/model.fbx";
            AssetDatabase.labels["Assets/Models/model.fbx"] = new[] { "Prop", "chamfer=3" };
            Check.Equal(0, Run("Assets/Models"));
            Check.That(AssetDatabase.labels["Assets/Models/model.fbx"].SequenceEqual(new[] { "Prop", "Chamfer=0.1" }), "labels");
            Check.Equal("Assets/Models/model.fbx", AssetDatabase.imported.Last());
        }

        /// What was imported with a label is chamfered: trying it would chamfer it twice.
        public static void A_second_run_leaves_models_alone()
        {
            Project.postprocessors.AddRange(new[] { typeof(ModelChamfer), typeof(ImportChanges) });
            try
            {
                Project.AddModel("Assets/Again/a.fbx", () => Scene.Holding(Shapes.Cube(), "Model"));
                EditorApplication.Idle();
                AssetDatabase.imported.Clear();
                Check.Equal(0, Run("Assets/Again"));
                EditorApplication.Idle();
                Check.Equal("Assets/Again/a.fbx", AssetDatabase.imported.Single());
                AssetDatabase.imported.Clear();
                Check.Equal(0, Run("Assets/Again"));
                Check.Equal(0, AssetDatabase.imported.Count);
                Check.That(Debug.logged.Last().EndsWith("1 mesh chamfered already left alone"), Debug.logged.Last());
                Check.Equal(0, Run("Assets/Again", "0.2"));
                Check.Equal("Assets/Again/a.fbx", AssetDatabase.imported.Single());
                Check.That(Debug.logged.Last().EndsWith("\nCube: 12 hard edges: 12 full, 0 narrowed, 0 skipped; 12 -> 44 triangles"), Debug.logged.Last());
            }
            finally { Project.postprocessors.Clear(); }
        }

        public static void The_editor_ends_with_the_exit_code()
        {
            ChamferBatch.Run();
            Check.Equal(2, EditorApplication.exitCode);
        }

        public static void Failures_have_an_exit_code()
        {
            var broken = Shapes.Cube();
            broken.normals = new Vector3[0];
            Scene.MakeAsset(Scene.Holding(broken, "Broken"), "Assets/Broken/Broken.prefab");
            Check.Equal(1, Run("Assets/Broken"));
            Check.That(Debug.logged.Last().Contains("normals"), Debug.logged.Last());
        }

        public static void Bad_arguments_have_an_exit_code()
        {
            Check.Equal(2, ChamferBatch.Run(new string[0]));
            Check.Equal(2, ChamferBatch.Run(new[] { "-chamferFolder", "Elsewhere" }));
            Check.Equal(2, ChamferBatch.Run(new[] { "-chamferFolder", "Assets/Batch", "-chamferWidth", "wide" }));
        }
    }
}
