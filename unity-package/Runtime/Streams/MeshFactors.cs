using System;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>How many times the width the parts of a mesh get; null where all get the same.</summary>
    internal struct MeshFactors
    {
        /// <summary><c>#submeshes</c></summary>
        public float[] Submeshes;

        /// <summary><c>#vertices</c></summary>
        public float[] Vertices;

        /// <summary>As the settings say.</summary>
        /// <param name="materials">The names of the renderer's, one for each submesh; null for none.</param>
        internal static MeshFactors Of(MeshArrays mesh, EdgeSettings edges, string[] materials)
        {
            return new MeshFactors { Submeshes = OfMaterials(mesh, edges, materials), Vertices = OfMask(mesh.Colors, edges.mask) };
        }

        /// <summary>Nothing of the mesh is chamfered: it only stands there.</summary>
        internal static MeshFactors Zero(MeshArrays mesh)
        {
            return new MeshFactors { Submeshes = new float[mesh.Submeshes.Length] };
        }

        private static float[] OfMaterials(MeshArrays mesh, EdgeSettings edges, string[] materials)
        {
            if (!edges.HasMaterials || materials == null) { return null; }
            var factors = new float[mesh.Submeshes.Length];
            for (int i = 0; i < factors.Length; i++) { factors[i] = i < materials.Length ? edges.FactorOf(materials[i]) : 1; }
            return Array.TrueForAll(factors, factor => factor == 1) ? null : factors;
        }

        private static float[] OfMask(Color[] colors, MaskChannel mask)
        {
            if (colors == null || mask == MaskChannel.None) { return null; }
            return Array.ConvertAll(colors, color => Mathf.Clamp(Channel(color, mask), 0, 1));
        }

        private static float Channel(Color color, MaskChannel mask)
        {
            switch (mask)
            {
                case MaskChannel.Red: return color.r;
                case MaskChannel.Green: return color.g;
                case MaskChannel.Blue: return color.b;
                default: return color.a;
            }
        }
    }
}
