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
        private readonly List<Pull> blended = new List<Pull>();

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
            int before = weights.Count;
            if (blend.IsOne(out vertex)) { Keep(vertex); }
            else { Blend(blend); }
            bonesPerVertex.Add((byte)(weights.Count - before));
        }

        private void Keep(int vertex)
        {
            for (int i = 0; i < source.BonesPerVertex[vertex]; i++) { weights.Add(source.Weights[firstWeight[vertex] + i]); }
        }

        private unsafe void Blend(NativeBlend blend)
        {
            blended.Clear();
            for (int i = 0; i < NativeBlend.Count; i++)
            {
                if (blend.Weights[i] != 0) { Gather((int)blend.Vertices[i], blend.Weights[i]); }
            }
            AddStrongest();
        }

        private void Gather(int vertex, double share)
        {
            for (int i = 0; i < source.BonesPerVertex[vertex]; i++)
            {
                var bone = source.Weights[firstWeight[vertex] + i];
                var pull = new Pull { Bone = bone.boneIndex, Weight = share * bone.weight };
                int known = blended.FindIndex(other => other.Bone == pull.Bone);
                if (known < 0) { blended.Add(pull); continue; }
                pull.Weight += blended[known].Weight;
                blended[known] = pull;
            }
        }

        /// <summary>The strongest bones first, as Unity wants them, and of sum 1.</summary>
        private void AddStrongest()
        {
            blended.RemoveAll(pull => pull.Weight <= 0);
            blended.Sort(StrongestFirst);
            if (blended.Count > mostBones) { blended.RemoveRange(mostBones, blended.Count - mostBones); }
            double sum = 0;
            foreach (var pull in blended) { sum += pull.Weight; }
            foreach (var pull in blended)
            {
                weights.Add(new BoneWeight1 { boneIndex = pull.Bone, weight = (float)(pull.Weight / sum) });
            }
        }

        private static int StrongestFirst(Pull a, Pull b)
        {
            int byWeight = b.Weight.CompareTo(a.Weight);
            return byWeight != 0 ? byWeight : a.Bone.CompareTo(b.Bone);
        }

        /// <summary>A bone's weight on its way through a blend, in double precision as on the command line.</summary>
        private struct Pull
        {
            public int Bone;
            public double Weight;
        }
    }
}
