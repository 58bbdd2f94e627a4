using System.Collections.Generic;

namespace Chamfer
{
    /// <summary>What became of the hard edges of one mesh.</summary>
    public sealed class ChamferReport
    {
        /// <summary>How many vertices the source mesh has.</summary>
        public int VerticesBefore { get; internal set; }

        /// <summary>How many vertices the result has.</summary>
        public int VerticesAfter { get; internal set; }

        /// <summary>How many triangles the source mesh has.</summary>
        public int TrianglesBefore { get; internal set; }

        /// <summary>How many triangles the result has.</summary>
        public int TrianglesAfter { get; internal set; }

        /// <summary>How many faces of four corners there are, which stay as they are.</summary>
        public int Quads { get; internal set; }

        /// <summary>Hard edges, with those whose two sides share no edge.</summary>
        public int HardEdges { get; internal set; }

        /// <summary>Those at full width.</summary>
        public int Chamfered { get; internal set; }

        /// <summary>Those chamfered, but narrower somewhere.</summary>
        public int Narrowed { get; internal set; }

        /// <summary>Those left as they were.</summary>
        public int Skipped { get; internal set; }

        /// <summary>The width asked for, in mesh units.</summary>
        public float Width { get; internal set; }

        /// <summary>Mean width as a share (0 to 1) of the width asked for, weighted by edge length.</summary>
        public float MeanWidth { get; internal set; }

        /// <summary>How long the native part took; in a scene, for all of its meshes together.</summary>
        public double Milliseconds { get; internal set; }

        /// <summary>What became of each hard edge.</summary>
        public IReadOnlyList<EdgeVerdict> Verdicts { get; internal set; }

        internal const int OutcomeSlots = 3;

        internal int[] Counts { get; set; }

        /// <summary>How many edges have this outcome for this reason.</summary>
        public int Count(EdgeOutcome outcome, EdgeReason reason)
        {
            return Counts[(int)outcome * (Counts.Length / OutcomeSlots) + (int)reason];
        }

        /// <summary>The counts in one line.</summary>
        public override string ToString()
        {
            return HardEdges + " hard edges: " + Chamfered + " full, " + Narrowed + " narrowed, " + Skipped
                + " skipped; " + TrianglesBefore + " -> " + TrianglesAfter + " triangles";
        }
    }
}
