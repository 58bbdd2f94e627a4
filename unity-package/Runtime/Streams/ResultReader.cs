using System;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Copies what a native result holds.</summary>
    internal static class ResultReader
    {
        internal static MeshArrays Mesh(ResultHandle result, MeshArrays source)
        {
            var native = NativeMesh.Empty();
            Failure.Require(NativeMethods.ResultMesh(result, ref native));
            int count = (int)native.VertexCount;
            var mesh = new MeshArrays
            {
                Name = source.Name,
                Bounds = source.Bounds,
                HasWideIndices = source.HasWideIndices,
                Positions = PinnedArrays.Copy<Vector3>(native.Positions, count) ?? new Vector3[0],
                Normals = PinnedArrays.Copy<Vector3>(native.Normals, count),
                Tangents = PinnedArrays.Copy<Vector4>(native.Tangents, count),
                Colors = PinnedArrays.Copy<Color>(native.Colors, count),
                HasByteColors = source.HasByteColors,
                Submeshes = Submeshes(native, source)
            };
            for (int channel = 0; channel < mesh.Uvs.Length; channel++)
            {
                mesh.Uvs[channel] = Uvs(native.Uvs[channel], count);
            }
            return mesh;
        }

        internal static NativeVertexSource[] VertexSources(ResultHandle result)
        {
            IntPtr sources;
            uint count;
            Failure.Require(NativeMethods.ResultVertexSources(result, out sources, out count));
            return PinnedArrays.Copy<NativeVertexSource>(sources, (int)count) ?? new NativeVertexSource[0];
        }

        internal static ChamferReport Report(ResultHandle result, MeshArrays source, MeshArrays output, bool keepsVerdicts)
        {
            var verdicts = new NativeVerdicts(result);
            var totals = NativeTotals.Empty();
            Failure.Require(NativeMethods.ResultTotals(result, ref totals));
            return new ChamferReport
            {
                VerticesBefore = source.Positions.Length,
                VerticesAfter = output.Positions.Length,
                Quads = Quads(source),
                TrianglesBefore = Triangles(source),
                TrianglesAfter = Triangles(output),
                HardEdges = (int)totals.HardEdges,
                Chamfered = (int)totals.Chamfered,
                Narrowed = (int)totals.Narrowed,
                Skipped = (int)totals.Skipped,
                Width = totals.Width,
                MeanWidth = totals.MeanWidth,
                Counts = verdicts.Counts(),
                Verdicts = keepsVerdicts ? verdicts.ToArray() : new EdgeVerdict[0]
            };
        }

        private static Array Uvs(NativeUv uv, int count)
        {
            switch (uv.Components)
            {
                case 2: return PinnedArrays.Copy<Vector2>(uv.Values, count);
                case 3: return PinnedArrays.Copy<Vector3>(uv.Values, count);
                case 4: return PinnedArrays.Copy<Vector4>(uv.Values, count);
                default: return null;
            }
        }

        private static SubmeshArrays[] Submeshes(NativeMesh native, MeshArrays source)
        {
            var counts = PinnedArrays.Copy<int>(native.SubmeshIndexCounts, (int)native.SubmeshCount) ?? new int[0];
            var submeshes = new SubmeshArrays[counts.Length];
            int start = 0;
            for (int submesh = 0; submesh < counts.Length; submesh++)
            {
                bool isNew = submesh >= source.Submeshes.Length;
                submeshes[submesh] = isNew || source.Submeshes[submesh].IsTriangles
                    ? Triangles(native.Indices, start, counts[submesh])
                    : source.Submeshes[submesh];
                start += counts[submesh];
            }
            return submeshes;
        }

        /// <summary>Copied once, right into the array that the mesh gets.</summary>
        private static SubmeshArrays Triangles(IntPtr all, int start, int count)
        {
            var indices = count > 0 ? PinnedArrays.Copy<int>(IntPtr.Add(all, start * sizeof(int)), count) : new int[0];
            return new SubmeshArrays { Topology = MeshTopology.Triangles, Indices = indices };
        }

        private static int Triangles(MeshArrays mesh)
        {
            int corners = 0;
            foreach (var submesh in mesh.Submeshes)
            {
                if (submesh.IsTriangles) { corners += submesh.Indices.Length; }
            }
            return corners / 3;
        }

        private static int Quads(MeshArrays mesh)
        {
            int corners = 0;
            foreach (var submesh in mesh.Submeshes)
            {
                if (submesh.Topology == MeshTopology.Quads) { corners += submesh.Indices.Length; }
            }
            return corners / 4;
        }
    }
}
