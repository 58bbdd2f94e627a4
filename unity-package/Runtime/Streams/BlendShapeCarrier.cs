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

        private static unsafe Vector3 Blend(Vector3[] deltas, NativeBlend blend)
        {
            int vertex;
            if (blend.IsOne(out vertex)) { return deltas[vertex]; }
            var sum = new Vector3();
            for (int i = 0; i < NativeBlend.Count; i++)
            {
                if (blend.Weights[i] != 0) { sum += deltas[blend.Vertices[i]] * blend.Weights[i]; }
            }
            return sum;
        }
    }
}
