using System;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Shows arrays and settings to the native library.</summary>
    internal static class NativeInput
    {
        /// <param name="settings">How to chamfer.</param>
        /// <param name="scale">In which the mesh is measured; zeros for the mesh as it is.</param>
        internal static unsafe NativeOptions Options(ChamferSettings settings, Vector3 scale = default(Vector3))
        {
            var edges = settings.edges;
            var options = new NativeOptions
            {
                StructSize = (uint)sizeof(NativeOptions),
                Width = settings.width,
                WidthUnit = (uint)settings.unit,
                Verify = (uint)settings.verify,
                SubmeshMode = (uint)settings.submeshMode,
                Submesh = (uint)settings.submesh,
                Threads = 1,
                LeastBreadth = settings.leastBreadth,
                WidthMode = (uint)edges.widthMode,
                MinAngle = edges.minAngle,
                MaxAngle = edges.maxAngle,
                Convexity = (uint)edges.convexity,
                HardAngle = edges.hardAngle,
                Evenness = settings.evenness,
                Segments = (uint)settings.segments,
                Profile = settings.profile
            };
            options.Scale[0] = scale.x;
            options.Scale[4] = scale.y;
            options.Scale[8] = scale.z;
            return options;
        }

        /// <summary>A view that holds as long as the pins. Submeshes of other topologies are empty in it.</summary>
        internal static NativeMesh Mesh(MeshArrays source, PinnedArrays pins, MeshFactors factors = default(MeshFactors))
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
            PinIndices(ref mesh, source, pins);
            mesh.SubmeshFactors = pins.Pin(factors.Submeshes);
            mesh.VertexFactors = pins.Pin(factors.Vertices);
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

        private static void PinIndices(ref NativeMesh mesh, MeshArrays source, PinnedArrays pins)
        {
            var counts = Array.ConvertAll(source.Submeshes, one => one.IsTriangles ? (uint)one.Indices.Length : 0);
            mesh.SubmeshCount = (uint)counts.Length;
            mesh.SubmeshIndexCounts = pins.Pin(counts);
            var indices = source.Triangles();
            mesh.IndexCount = (uint)indices.Length;
            mesh.Indices = pins.Pin(indices);
        }
    }
}
