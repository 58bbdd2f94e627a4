using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What rules ask about a model.</summary>
    internal struct ModelFacts
    {
        internal string Path { get; private set; }

        internal IReadOnlyList<string> Labels { get; private set; }

        internal int Triangles { get; private set; }

        /// <summary>The largest side of the largest mesh.</summary>
        internal float Size { get; private set; }

        /// <summary>That of the file, without what tells its kind.</summary>
        internal string Name => System.IO.Path.GetFileNameWithoutExtension(Path);

        /// <summary>What is known without its meshes.</summary>
        internal static ModelFacts At(string path)
        {
            return At(path, AssetDatabase.GetLabels(AssetDatabase.GUIDFromAssetPath(path)));
        }

        internal static ModelFacts At(string path, IReadOnlyList<string> labels)
        {
            return new ModelFacts { Path = path, Labels = labels };
        }

        /// <summary>The same model, with what its meshes tell; each counts once.</summary>
        internal ModelFacts With(IEnumerable<Mesh> meshes)
        {
            var facts = this;
            foreach (var mesh in new HashSet<Mesh>(meshes))
            {
                for (int i = 0; i < mesh.subMeshCount; i++) { facts.Triangles += TrianglesOf(mesh, i); }
                var size = mesh.bounds.size;
                facts.Size = Mathf.Max(facts.Size, Mathf.Max(size.x, Mathf.Max(size.y, size.z)));
            }
            return facts;
        }

        /// <summary>The same model, as it was before it was chamfered.</summary>
        internal ModelFacts With(ChamferRecord record)
        {
            var facts = this;
            facts.Triangles = record.triangles;
            facts.Size = record.size;
            return facts;
        }

        private static int TrianglesOf(Mesh mesh, int submesh)
        {
            return mesh.GetTopology(submesh) == MeshTopology.Triangles ? (int)mesh.GetIndexCount(submesh) / 3 : 0;
        }
    }
}
