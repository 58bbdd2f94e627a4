using System;
using System.Collections.Generic;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Meshes that stand together, read on the main thread, each once.</summary>
    internal sealed class SceneArrays
    {
        private readonly Dictionary<Mesh, int> numbers = new Dictionary<Mesh, int>();
        private readonly List<Mesh> meshes = new List<Mesh>();
        private readonly List<MeshArrays> arrays = new List<MeshArrays>();
        private readonly List<PlacedArrays> placed = new List<PlacedArrays>();

        private readonly Func<Mesh, MeshArrays> read;

        internal SceneArrays(IEnumerable<PlacedMesh> objects, Func<Mesh, MeshArrays> read = null)
        {
            this.read = read ?? MeshReader.Read;
            foreach (var item in objects) { Add(item); }
        }

        /// <summary><c>#meshes</c></summary>
        internal IReadOnlyList<Mesh> Meshes => meshes;

        /// <summary><c>#meshes</c></summary>
        internal IReadOnlyList<MeshArrays> Arrays => arrays;

        internal IReadOnlyList<PlacedArrays> Placed => placed;

        /// <summary>Adds an object; a mesh that cannot be read throws and adds nothing.</summary>
        internal void Add(PlacedMesh item)
        {
            int number;
            if (ReferenceEquals(item.Mesh, null) || !numbers.TryGetValue(item.Mesh, out number))
            {
                arrays.Add(read(item.Mesh));
                number = meshes.Count;
                meshes.Add(item.Mesh);
                numbers.Add(item.Mesh, number);
            }
            placed.Add(new PlacedArrays
            {
                Mesh = number,
                Transform = item.Transform,
                WorldScale = item.WorldScale,
                Materials = item.MaterialNames ?? NamesOf(item.Materials)
            });
        }

        /// <summary>The names of materials, which only the main thread may ask for.</summary>
        internal static string[] NamesOf(Material[] materials)
        {
            return materials == null ? null : Array.ConvertAll(materials, one => one != null ? one.name : "");
        }

        /// <summary>Takes a mesh out of the scene, and all that follow move up.</summary>
        internal void Remove(int mesh)
        {
            numbers.Remove(meshes[mesh]);
            meshes.RemoveAt(mesh);
            arrays.RemoveAt(mesh);
            placed.RemoveAll(item => item.Mesh == mesh);
            for (int i = mesh; i < meshes.Count; i++) { numbers[meshes[i]] = i; }
            for (int i = 0; i < placed.Count; i++)
            {
                var item = placed[i];
                if (item.Mesh > mesh) { item.Mesh--; }
                placed[i] = item;
            }
        }
    }
}
