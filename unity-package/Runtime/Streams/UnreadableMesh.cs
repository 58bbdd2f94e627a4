using UnityEngine;
#if UNITY_EDITOR
using System;
using Unity.Collections;
using UnityEditor;
using UnityEngine.Rendering;
#endif

namespace Chamfer.Streams
{
    /// <summary>Reads meshes without Read/Write, as far as the editor allows.</summary>
    internal static class UnreadableMesh
    {
#if !UNITY_EDITOR
        internal static MeshArrays Read(Mesh mesh)
        {
            throw new MeshNotReadableException(mesh.name, "");
        }
#else
        internal static MeshArrays Read(Mesh mesh)
        {
            // A snapshot lacks what deforms a mesh, and shows the triangles of all levels of detail as one.
            if (SkinReader.IsDeformed(mesh) || MeshLods.Count(mesh) > 1) { return ReadCopy(mesh); }
            using (var snapshot = MeshUtility.AcquireReadOnlyMeshData(mesh))
            {
                var arrays = Streams(snapshot[0]);
                arrays.Name = mesh.name;
                arrays.Bounds = mesh.bounds;
                arrays.HasWideIndices = MeshReader.HasWideIndices(mesh);
                arrays.HasByteColors = MeshReader.HasByteColors(mesh);
                return arrays;
            }
        }

        /// <summary>Unity has the data in memory: a copy of the mesh that is marked as readable can be read.</summary>
        private static MeshArrays ReadCopy(Mesh mesh)
        {
            var copy = UnityEngine.Object.Instantiate(mesh);
            try
            {
                MeshFlags.SetReadable(copy, true);
                if (!copy.isReadable || copy.vertexCount != mesh.vertexCount)
                {
                    throw new MeshNotReadableException(mesh.name, ", because it has a skin or blend shapes");
                }
                var arrays = MeshReader.Read(copy);
                arrays.Name = mesh.name;
                return arrays;
            }
            finally { UnityEngine.Object.DestroyImmediate(copy); }
        }

        private static MeshArrays Streams(Mesh.MeshData data)
        {
            var arrays = new MeshArrays
            {
                Positions = Values<Vector3>(data, VertexAttribute.Position, data.GetVertices),
                Normals = Values<Vector3>(data, VertexAttribute.Normal, data.GetNormals),
                Tangents = Values<Vector4>(data, VertexAttribute.Tangent, data.GetTangents),
                Colors = Values<Color>(data, VertexAttribute.Color, data.GetColors),
                Submeshes = Submeshes(data)
            };
            for (int channel = 0; channel < arrays.Uvs.Length; channel++) { arrays.Uvs[channel] = Uvs(data, channel); }
            return arrays;
        }

        private static T[] Values<T>(Mesh.MeshData data, VertexAttribute attribute, Action<NativeArray<T>> read)
            where T : struct
        {
            if (!data.HasVertexAttribute(attribute)) { return null; }
            using (var values = new NativeArray<T>(data.vertexCount, Allocator.TempJob))
            {
                read(values);
                return values.ToArray();
            }
        }

        private static Array Uvs(Mesh.MeshData data, int channel)
        {
            var attribute = MeshReader.UvAttribute(channel);
            switch (data.HasVertexAttribute(attribute) ? data.GetVertexAttributeDimension(attribute) : 0)
            {
                case 0: return null;
                case 3: return Values<Vector3>(data, attribute, values => data.GetUVs(channel, values));
                case 4: return Values<Vector4>(data, attribute, values => data.GetUVs(channel, values));
                default: return Values<Vector2>(data, attribute, values => data.GetUVs(channel, values));
            }
        }

        private static SubmeshArrays[] Submeshes(Mesh.MeshData data)
        {
            var submeshes = new SubmeshArrays[data.subMeshCount];
            for (int submesh = 0; submesh < submeshes.Length; submesh++)
            {
                var descriptor = data.GetSubMesh(submesh);
                submeshes[submesh].Topology = descriptor.topology;
                using (var indices = new NativeArray<int>(descriptor.indexCount, Allocator.TempJob))
                {
                    data.GetIndices(indices, submesh, true);
                    submeshes[submesh].Indices = indices.ToArray();
                }
            }
            return submeshes;
        }
#endif
    }
}
