using System;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Shows arrays and settings to the native library.</summary>
    internal static class NativeInput
    {
        internal static unsafe NativeOptions Options(ChamferSettings settings)
        {
            return new NativeOptions
            {
                StructSize = (uint)sizeof(NativeOptions),
                Width = settings.width,
                WidthUnit = (uint)settings.unit,
                Verify = (uint)settings.verify,
                SubmeshMode = (uint)settings.submeshMode,
                Submesh = (uint)settings.submesh,
                Threads = 1,
                LeastBreadth = settings.leastBreadth
            };
        }

        /// <summary>A view that holds as long as the pins. Submeshes of other topologies are empty in it.</summary>
        internal static NativeMesh Mesh(MeshArrays source, PinnedArrays pins)
        {
            var mesh = NativeMesh.Empty();
            mesh.VertexCount = (uint)source.Positions.Length;
            mesh.Positions = pins.Pin(source.Positions);
            mesh.Normals = pins.Pin(source.Normals);
            mesh.Tangents = pins.Pin(source.Tangents);
            mesh.Colors = pins.Pin(source.Colors);
            for (int channel = 0; channel < source.Uvs.Length; channel++)
            {
                mesh.Uvs[channel] = Uv(source.Uvs[channel], pins);
            }
            PinIndices(ref mesh, source.Submeshes, pins);
            return mesh;
        }

        private static NativeUv Uv(Array values, PinnedArrays pins)
        {
            return new NativeUv { Components = Components(values), Values = pins.Pin(values) };
        }

        private static uint Components(Array values)
        {
            if (values is Vector2[]) { return 2; }
            if (values is Vector3[]) { return 3; }
            return values is Vector4[] ? 4u : 0u;
        }

        private static void PinIndices(ref NativeMesh mesh, SubmeshArrays[] submeshes, PinnedArrays pins)
        {
            var counts = Array.ConvertAll(submeshes, one => one.IsTriangles ? (uint)one.Indices.Length : 0);
            mesh.SubmeshCount = (uint)counts.Length;
            mesh.SubmeshIndexCounts = pins.Pin(counts);
            var indices = Indices(submeshes);
            mesh.IndexCount = (uint)indices.Length;
            mesh.Indices = pins.Pin(indices);
        }

        /// <summary>One after the other; where there is one only, itself.</summary>
        private static int[] Indices(SubmeshArrays[] submeshes)
        {
            var triangles = Array.FindAll(submeshes, one => one.IsTriangles);
            if (triangles.Length == 1) { return triangles[0].Indices; }
            int count = 0;
            foreach (var submesh in triangles) { count += submesh.Indices.Length; }
            var all = new int[count];
            int start = 0;
            foreach (var submesh in triangles)
            {
                submesh.Indices.CopyTo(all, start);
                start += submesh.Indices.Length;
            }
            return all;
        }
    }
}
