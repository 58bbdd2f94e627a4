using System.Collections.Generic;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Reads what deforms a mesh: bones and blend shapes.</summary>
    internal static class SkinReader
    {
        internal static bool IsDeformed(Mesh mesh)
        {
            return mesh.blendShapeCount > 0
                || mesh.HasVertexAttribute(UnityEngine.Rendering.VertexAttribute.BlendIndices);
        }

        internal static Skin Skin(Mesh mesh)
        {
            var bindposes = mesh.bindposes;
            // Both arrays are views into the mesh, which must not be disposed of.
            var bonesPerVertex = mesh.GetBonesPerVertex().ToArray();
            if (bindposes.Length == 0 && bonesPerVertex.Length == 0) { return null; }
            return new Skin
            {
                BonesPerVertex = bonesPerVertex,
                Weights = mesh.GetAllBoneWeights().ToArray(),
                Bindposes = bindposes
            };
        }

        internal static BlendShapeFrame[] BlendShapes(Mesh mesh)
        {
            var frames = new List<BlendShapeFrame>();
            for (int shape = 0; shape < mesh.blendShapeCount; shape++)
            {
                for (int frame = 0; frame < mesh.GetBlendShapeFrameCount(shape); frame++)
                {
                    frames.Add(Frame(mesh, shape, frame));
                }
            }
            return frames.ToArray();
        }

        private static BlendShapeFrame Frame(Mesh mesh, int shape, int frame)
        {
            var read = new BlendShapeFrame
            {
                Shape = mesh.GetBlendShapeName(shape),
                Weight = mesh.GetBlendShapeFrameWeight(shape, frame),
                Positions = new Vector3[mesh.vertexCount],
                Normals = new Vector3[mesh.vertexCount],
                Tangents = new Vector3[mesh.vertexCount]
            };
            mesh.GetBlendShapeFrameVertices(shape, frame, read.Positions, read.Normals, read.Tangents);
            return read;
        }
    }
}
