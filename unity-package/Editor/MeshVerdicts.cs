using System;
using System.Collections.Generic;
using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What became of the hard edges of a mesh, and where they are: worked out when somebody looks.</summary>
    internal sealed class MeshVerdicts
    {
        private readonly Vector3[] positions;
        private readonly int[][] ends = new int[ChamferReport.OutcomeSlots][];
        private readonly Vector3[][] segments = new Vector3[ChamferReport.OutcomeSlots][];

        /// <param name="source">What the edges are of; it need not be readable any more.</param>
        /// <param name="report">About the source's edges.</param>
        /// <param name="settings">What the mesh was made with.</param>
        internal MeshVerdicts(MeshArrays source, ChamferReport report, ChamferSettings settings)
        {
            Report = report;
            Settings = settings;
            bool hasBones = source.Skin != null && source.Skin.BonesPerVertex.Length > 0;
            Skin = hasBones ? source.Skin : null;
            positions = source.Positions;
        }

        internal ChamferReport Report { get; }

        internal ChamferSettings Settings { get; }

        /// <summary>The source's bone weights; null if it has none.</summary>
        internal Skin Skin { get; }

        /// <summary>Two points for each edge with that outcome.</summary>
        internal Vector3[] Segments(EdgeOutcome outcome)
        {
            int slot = (int)outcome;
            return segments[slot] ?? (segments[slot] = Array.ConvertAll(Ends(outcome), vertex => positions[vertex]));
        }

        /// <summary>As <see cref="Segments"/>, as vertices of the source.</summary>
        internal int[] Ends(EdgeOutcome outcome)
        {
            return ends[(int)outcome] ?? (ends[(int)outcome] = EndsOf(Report.Verdicts, outcome));
        }

        private static int[] EndsOf(IReadOnlyList<EdgeVerdict> verdicts, EdgeOutcome outcome)
        {
            var vertices = new List<int>();
            foreach (var verdict in verdicts)
            {
                if (verdict.Outcome != outcome) { continue; }
                vertices.Add(verdict.FirstVertex);
                vertices.Add(verdict.SecondVertex);
            }
            return vertices.ToArray();
        }
    }
}
