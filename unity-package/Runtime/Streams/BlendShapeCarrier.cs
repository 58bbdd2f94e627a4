using System;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Blends what each blend shape adds from the source vertices that each vertex came from.</summary>
    internal static class BlendShapeCarrier
    {
        internal static BlendShapeFrame[] Carry(BlendShapeFrame[] frames, NativeVertexSource[] sources)
        {
            return Array.ConvertAll(frames, frame => new BlendShapeFrame
            {
                Shape = frame.Shape,
                Weight = frame.Weight,
                Positions = Array.ConvertAll(sources, source => Blend(frame.Positions, source.Surface)),
                Normals = Array.ConvertAll(sources, source => Blend(frame.Normals, source.Surface)),
                // Tangents follow the texture.
                Tangents = Array.ConvertAll(sources, source => Blend(frame.Tangents, source.TangentChart))
            });
        }

        /// <summary>In double precision, and by the sum of the weights: the command line does the same.</summary>
        private static unsafe Vector3 Blend(Vector3[] deltas, NativeBlend blend)
        {
            int vertex;
            if (blend.IsOne(out vertex)) { return deltas[vertex]; }
            double x = 0, y = 0, z = 0, total = 0;
            for (int i = 0; i < NativeBlend.Count; i++)
            {
                double weight = blend.Weights[i];
                if (weight == 0) { continue; }
                var delta = deltas[blend.Vertices[i]];
                x += weight * delta.x;
                y += weight * delta.y;
                z += weight * delta.z;
                total += weight;
            }
            return new Vector3((float)(x / total), (float)(y / total), (float)(z / total));
        }
    }
}
