using System.Linq;
using ChamferEditor;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Chamfer.PackageTests
{
    /// <summary>
    /// The whole way through a real editor: Unity's cube, its undo, its assets. Everything else is tested without one.
    /// </summary>
    public sealed class CubeTests
    {
        private const string Folder = "Assets/ChamferPackageTests";

        private GameObject cube;

        [SetUp]
        public void MakeCube()
        {
            cube = GameObject.CreatePrimitive(PrimitiveType.Cube);
            Undo.IncrementCurrentGroup();
        }

        [TearDown]
        public void Clean()
        {
            Object.DestroyImmediate(cube);
            AssetDatabase.DeleteAsset(Folder);
        }

        private Mesh Held => cube.GetComponent<MeshFilter>().sharedMesh;

        private static int TrianglesOf(Mesh mesh)
        {
            return mesh.triangles.Length / 3;
        }

        [Test]
        public void A_cube_gets_a_strip_for_each_edge_and_a_fill_for_each_corner()
        {
            var result = MeshChamfer.Run(Held, ChamferSettings.Default);
            Assert.AreEqual(12, result.Report.Chamfered);
            Assert.AreEqual(12 + 12 * 2 + 8, TrianglesOf(result.Mesh));
            Object.DestroyImmediate(result.Mesh);
        }

        [Test]
        public void One_undo_takes_the_menu_back()
        {
            var original = Held;
            ChamferTools.Chamfer(new Object[] { cube }, ChamferSettings.Default);
            Assert.AreEqual(44, TrianglesOf(Held));
            Assert.IsTrue(cube.GetComponent<ChamferModifier>().IsApplied);
            Undo.PerformUndo();
            Assert.AreSame(original, Held);
            Assert.IsTrue(cube.GetComponent<ChamferModifier>() == null);
        }

        [Test]
        public void A_second_run_changes_nothing()
        {
            ChamferTools.Chamfer(new Object[] { cube }, ChamferSettings.Default);
            var once = Held;
            ChamferTools.Chamfer(new Object[] { cube }, ChamferSettings.Default);
            Assert.AreSame(once, Held);
        }

        [Test]
        public void Reverting_gives_the_original_back()
        {
            var original = Held;
            ChamferTools.Chamfer(new Object[] { cube }, ChamferSettings.Default);
            ChamferTools.Revert(new Object[] { cube });
            Assert.AreSame(original, Held);
        }

        [Test]
        public void A_prefab_keeps_its_mesh()
        {
            AssetDatabase.CreateFolder("Assets", "ChamferPackageTests");
            string path = Folder + "/Cube.prefab";
            PrefabUtility.SaveAsPrefabAsset(cube, path);
            var prefab = AssetDatabase.LoadAssetAtPath<GameObject>(path);
            ChamferTools.Chamfer(new Object[] { prefab }, ChamferSettings.Default);
            AssetDatabase.ImportAsset(path, ImportAssetOptions.ForceUpdate);
            prefab = AssetDatabase.LoadAssetAtPath<GameObject>(path);
            Assert.AreEqual(44, TrianglesOf(prefab.GetComponent<MeshFilter>().sharedMesh));
            Assert.AreEqual(1, AssetDatabase.LoadAllAssetsAtPath(path).OfType<Mesh>().Count());
        }
    }
}
