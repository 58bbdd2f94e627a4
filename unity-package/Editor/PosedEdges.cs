using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Where the edges of a mesh with bones are now.</summary>
    internal static class PosedEdges
    {
        /// <summary>Two points in the world for each edge with a mark; null where bones do not move it.</summary>
        internal static Vector3[] Of(MeshVerdicts verdicts, EdgeMark mark, Component holder)
        {
            var renderer = holder as SkinnedMeshRenderer;
            var skin = verdicts.Skin;
            if (renderer == null || skin == null || renderer.bones.Length == 0) { return null; }
            var matrices = Matrices(renderer, skin.Bindposes);
            int[] first = FirstWeights(skin);
            var rest = verdicts.Segments(mark);
            var vertices = verdicts.Ends(mark);
            var posed = new Vector3[rest.Length];
            for (int i = 0; i < posed.Length; i++) { posed[i] = Posed(rest[i], vertices[i], skin, first, matrices); }
            return posed;
        }

        /// <summary>From the mesh in its bind pose to the world, bone by bone.</summary>
        private static Matrix4x4[] Matrices(SkinnedMeshRenderer renderer, Matrix4x4[] bindposes)
        {
            var bones = renderer.bones;
            var matrices = new Matrix4x4[bindposes.Length];
            for (int i = 0; i < matrices.Length; i++)
            {
                bool isThere = i < bones.Length && bones[i] != null;
                matrices[i] = isThere ? bones[i].localToWorldMatrix * bindposes[i] : renderer.transform.localToWorldMatrix;
            }
            return matrices;
        }

        private static int[] FirstWeights(Skin skin)
        {
            var first = new int[skin.BonesPerVertex.Length];
            for (int vertex = 1; vertex < first.Length; vertex++)
            {
                first[vertex] = first[vertex - 1] + skin.BonesPerVertex[vertex - 1];
            }
            return first;
        }

        private static Vector3 Posed(Vector3 rest, int vertex, Skin skin, int[] first, Matrix4x4[] matrices)
        {
            var posed = new Vector3();
            for (int i = first[vertex]; i < first[vertex] + skin.BonesPerVertex[vertex]; i++)
            {
                var weight = skin.Weights[i];
                if (weight.boneIndex >= matrices.Length) { continue; }
                posed += matrices[weight.boneIndex].MultiplyPoint3x4(rest) * weight.weight;
            }
            return posed;
        }
    }
}
