using System;
using System.Collections.Generic;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Blends bone weights from the source vertices that each vertex came from.</summary>
    internal sealed class SkinCarrier
    {
        /// <summary>Every engine blends four bones a vertex, so a blend may use as many.</summary>
        private const int FewestBones = 4;

        private readonly Skin source;
        private readonly int[] firstWeight;
        private readonly int mostBones;
        private readonly List<byte> bonesPerVertex = new List<byte>();
        private readonly List<BoneWeight1> weights = new List<BoneWeight1>();
        private readonly List<BoneWeight1> blended = new List<BoneWeight1>();

        private SkinCarrier(Skin source)
        {
            this.source = source;
            mostBones = FewestBones;
            firstWeight = new int[source.BonesPerVertex.Length];
            int first = 0;
            for (int vertex = 0; vertex < firstWeight.Length; vertex++)
            {
                firstWeight[vertex] = first;
                first += source.BonesPerVertex[vertex];
                mostBones = Math.Max(mostBones, source.BonesPerVertex[vertex]);
            }
        }

        internal static Skin Carry(Skin source, NativeVertexSource[] sources)
        {
            if (source == null || source.BonesPerVertex.Length == 0) { return source; }
            var carrier = new SkinCarrier(source);
            foreach (var vertex in sources) { carrier.Append(vertex.Surface); }
            return new Skin
            {
                BonesPerVertex = carrier.bonesPerVertex.ToArray(),
                Weights = carrier.weights.ToArray(),
                Bindposes = source.Bindposes
            };
        }

        private void Append(NativeBlend blend)
        {
            int vertex;
            blended.Clear();
            if (blend.IsOne(out vertex)) { Gather(vertex, 1); }
            else { GatherAll(blend); }
            bonesPerVertex.Add((byte)blended.Count);
            weights.AddRange(blended);
        }

        private unsafe void GatherAll(NativeBlend blend)
        {
            for (int i = 0; i < NativeBlend.Count; i++)
            {
                if (blend.Weights[i] != 0) { Gather((int)blend.Vertices[i], blend.Weights[i]); }
            }
            Normalize();
        }

        private void Gather(int vertex, float share)
        {
            for (int i = 0; i < source.BonesPerVertex[vertex]; i++)
            {
                var weight = source.Weights[firstWeight[vertex] + i];
                int known = share == 1 ? -1 : blended.FindIndex(other => other.boneIndex == weight.boneIndex);
                weight.weight *= share;
                if (known < 0) { blended.Add(weight); continue; }
                weight.weight += blended[known].weight;
                blended[known] = weight;
            }
        }

        /// <summary>The strongest bones first, as Unity wants them, and of sum 1.</summary>
        private void Normalize()
        {
            blended.RemoveAll(bone => bone.weight <= 0);
            blended.Sort(StrongestFirst);
            if (blended.Count > mostBones) { blended.RemoveRange(mostBones, blended.Count - mostBones); }
            float sum = 0;
            foreach (var bone in blended) { sum += bone.weight; }
            for (int i = 0; i < blended.Count; i++)
            {
                var bone = blended[i];
                bone.weight /= sum;
                blended[i] = bone;
            }
        }

        private static int StrongestFirst(BoneWeight1 a, BoneWeight1 b)
        {
            int byWeight = b.weight.CompareTo(a.weight);
            return byWeight != 0 ? byWeight : a.boneIndex.CompareTo(b.boneIndex);
        }
    }
}
