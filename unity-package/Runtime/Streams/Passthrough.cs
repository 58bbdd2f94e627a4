using System;
using System.Collections.Generic;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>
    /// Keeps lines, points and quads where they were: a vertex that they share with triangles may have moved,
    /// so they get a copy of the source's.
    /// </summary>
    internal static class Passthrough
    {
        /// <summary>Appends the copies to the output; returns what each of its vertices came from.</summary>
        internal static NativeVertexSource[] Restore(
            MeshArrays source,
            MeshArrays output,
            NativeVertexSource[] sources)
        {
            var copies = new List<int>();
            var copyOf = new Dictionary<int, int>();
            for (int submesh = 0; submesh < source.Submeshes.Length; submesh++)
            {
                if (source.Submeshes[submesh].IsTriangles) { continue; }
                foreach (int vertex in source.Submeshes[submesh].Indices)
                {
                    if (sources[vertex].Is(vertex) || copyOf.ContainsKey(vertex)) { continue; }
                    copyOf.Add(vertex, sources.Length + copies.Count);
                    copies.Add(vertex);
                }
            }
            if (copies.Count == 0) { return sources; }
            Append(source, output, copies);
            Redirect(output.Submeshes, copyOf);
            var identities = copies.ConvertAll(NativeVertexSource.Of);
            return Concat(sources, identities);
        }

        private static void Append(MeshArrays source, MeshArrays output, List<int> copies)
        {
            output.Positions = (Vector3[])Grown(output.Positions, source.Positions, copies);
            output.Normals = (Vector3[])Grown(output.Normals, source.Normals, copies);
            output.Tangents = (Vector4[])Grown(output.Tangents, source.Tangents, copies);
            output.Colors = (Color[])Grown(output.Colors, source.Colors, copies);
            for (int channel = 0; channel < output.Uvs.Length; channel++)
            {
                output.Uvs[channel] = Grown(output.Uvs[channel], source.Uvs[channel], copies);
            }
        }

        private static Array Grown(Array values, Array source, List<int> copies)
        {
            if (values == null) { return null; }
            var grown = Array.CreateInstance(values.GetType().GetElementType(), values.Length + copies.Count);
            Array.Copy(values, grown, values.Length);
            for (int i = 0; i < copies.Count; i++) { Array.Copy(source, copies[i], grown, values.Length + i, 1); }
            return grown;
        }

        private static void Redirect(SubmeshArrays[] submeshes, Dictionary<int, int> copyOf)
        {
            for (int submesh = 0; submesh < submeshes.Length; submesh++)
            {
                if (submeshes[submesh].IsTriangles) { continue; }
                submeshes[submesh].Indices = Array.ConvertAll(submeshes[submesh].Indices, vertex => Copy(vertex, copyOf));
            }
        }

        private static int Copy(int vertex, Dictionary<int, int> copyOf)
        {
            int copy;
            return copyOf.TryGetValue(vertex, out copy) ? copy : vertex;
        }

        private static NativeVertexSource[] Concat(NativeVertexSource[] first, List<NativeVertexSource> second)
        {
            var all = new NativeVertexSource[first.Length + second.Count];
            first.CopyTo(all, 0);
            second.CopyTo(all, first.Length);
            return all;
        }
    }
}
