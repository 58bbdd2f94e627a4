using System;
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;

namespace Chamfer.Streams
{
    /// <summary>Reads all streams of a mesh, on the main thread.</summary>
    internal static class MeshReader
    {
        internal static MeshArrays Read(Mesh mesh)
        {
            if (mesh == null) { throw new ArgumentNullException(nameof(mesh)); }
            if (!mesh.isReadable) { return UnreadableMesh.Read(mesh); }
            var arrays = new MeshArrays
            {
                Name = mesh.name,
                Bounds = mesh.bounds,
                HasWideIndices = HasWideIndices(mesh),
                Positions = mesh.vertices,
                Normals = OrNull(mesh.normals),
                Tangents = OrNull(mesh.tangents),
                Colors = OrNull(mesh.colors),
                HasByteColors = HasByteColors(mesh),
                Submeshes = Submeshes(mesh),
                Skin = SkinReader.Skin(mesh),
                BlendShapes = SkinReader.BlendShapes(mesh)
            };
            for (int channel = 0; channel < arrays.Uvs.Length; channel++) { arrays.Uvs[channel] = Uvs(mesh, channel); }
            return arrays;
        }

        internal static bool HasWideIndices(Mesh mesh)
        {
            return mesh.indexFormat == IndexFormat.UInt32;
        }

        internal static bool HasByteColors(Mesh mesh)
        {
            return mesh.HasVertexAttribute(VertexAttribute.Color)
                && mesh.GetVertexAttributeFormat(VertexAttribute.Color) == VertexAttributeFormat.UNorm8;
        }

        internal static VertexAttribute UvAttribute(int channel)
        {
            return VertexAttribute.TexCoord0 + channel;
        }

        private static T[] OrNull<T>(T[] values)
        {
            return values.Length == 0 ? null : values;
        }

        private static SubmeshArrays[] Submeshes(Mesh mesh)
        {
            var submeshes = new SubmeshArrays[mesh.subMeshCount];
            for (int submesh = 0; submesh < submeshes.Length; submesh++)
            {
                submeshes[submesh].Topology = mesh.GetTopology(submesh);
                submeshes[submesh].Indices = mesh.GetIndices(submesh);
            }
            return submeshes;
        }

        private static Array Uvs(Mesh mesh, int channel)
        {
            var attribute = UvAttribute(channel);
            switch (mesh.HasVertexAttribute(attribute) ? mesh.GetVertexAttributeDimension(attribute) : 0)
            {
                case 0: return null;
                case 3: return Uvs3(mesh, channel);
                case 4: return Uvs4(mesh, channel);
                default: return Uvs2(mesh, channel);
            }
        }

        private static Array Uvs2(Mesh mesh, int channel)
        {
            var values = new List<Vector2>();
            mesh.GetUVs(channel, values);
            return values.ToArray();
        }

        private static Array Uvs3(Mesh mesh, int channel)
        {
            var values = new List<Vector3>();
            mesh.GetUVs(channel, values);
            return values.ToArray();
        }

        private static Array Uvs4(Mesh mesh, int channel)
        {
            var values = new List<Vector4>();
            mesh.GetUVs(channel, values);
            return values.ToArray();
        }
    }
}
