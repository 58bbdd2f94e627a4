// Objects for the tests of the editor.
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class Scene
    {
        /// Two objects that share a cube, and below them a skinned one.
        internal static GameObject Hierarchy(out Mesh shared)
        {
            shared = Shapes.Cube();
            var root = Holding(shared, "Root");
            var child = Holding(shared, "Child");
            var skinned = new GameObject("Skinned");
            skinned.AddComponent<SkinnedMeshRenderer>().sharedMesh = Shapes.FullCube();
            root.children.Add(child);
            child.children.Add(skinned);
            Undo.Click();
            return root;
        }

        /// A cube, and below it an open one whose rim lies on its edges, where the distance is 2.
        internal static GameObject Resting(float distance, string name = "Resting")
        {
            var root = Holding(Shapes.Cube(), name);
            var child = Holding(Shapes.OpenCube(), "Lid");
            child.transform.localPosition = new Vector3(distance, 0, 0);
            root.children.Add(child);
            // Where it stands as a whole does not matter.
            root.transform.localPosition = new Vector3(-300, 20, 7);
            root.transform.localScale = new Vector3(-1, 0.5f, 2);
            Undo.Click();
            return root;
        }

        /// Whether a cube has the edges still that the open one rests on.
        internal static bool KeepsEdges(Mesh cube)
        {
            return System.Array.Exists(cube.vertices, p => p.x == 1 && System.Math.Abs(p.y) == 1);
        }

        internal static GameObject Holding(Mesh mesh, string name)
        {
            var item = new GameObject(name);
            item.AddComponent<MeshFilter>().sharedMesh = mesh;
            item.AddComponent<MeshRenderer>().sharedMaterials = new[] { new Material { name = "Wood" } };
            return item;
        }

        internal static Mesh MeshOf(GameObject item) { return ChamferEditor.MeshSlot.In(item, false)[0].Mesh; }

        /// Puts an object and all below it into a file of the project.
        internal static void MakeAsset(GameObject item, string path)
        {
            AssetDatabase.paths[item] = path;
            foreach (var component in item.GetComponentsInChildren<Component>(true))
            {
                EditorUtility.persistent.Add(component);
                AssetDatabase.paths[component] = path;
            }
        }

        /// The files of a folder, each once.
        internal static List<string> FilesIn(string folder)
        {
            return AssetDatabase.paths.Where(entry => entry.Key != null && entry.Value.StartsWith(folder)).Select(entry => entry.Value).Distinct().ToList();
        }

        internal static List<Mesh> MeshesIn(string path)
        {
            var meshes = new List<Mesh>();
            foreach (var asset in AssetDatabase.LoadAllAssetsAtPath(path))
            {
                if (asset is Mesh && asset != null) { meshes.Add((Mesh)asset); }
            }
            return meshes;
        }
    }
}
