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
        private readonly Dictionary<EdgeMark, int[]> ends = new Dictionary<EdgeMark, int[]>();
        private readonly Dictionary<EdgeMark, Vector3[]> segments = new Dictionary<EdgeMark, Vector3[]>();

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

        /// <summary>Two points for each edge with that mark.</summary>
        internal Vector3[] Segments(EdgeMark mark)
        {
            Vector3[] found;
            if (!segments.TryGetValue(mark, out found))
            {
                segments[mark] = found = Array.ConvertAll(Ends(mark), vertex => positions[vertex]);
            }
            return found;
        }

        /// <summary>As <see cref="Segments"/>, as vertices of the source.</summary>
        internal int[] Ends(EdgeMark mark)
        {
            int[] found;
            if (!ends.TryGetValue(mark, out found)) { ends[mark] = found = EndsOf(Report.Verdicts, mark); }
            return found;
        }

        private static EdgeMark MarkOf(EdgeVerdict verdict)
        {
            switch (verdict.Outcome)
            {
                case EdgeOutcome.Full: return EdgeMark.Full;
                case EdgeOutcome.Narrowed: return EdgeMark.Narrowed;
                default: return verdict.Reason == EdgeReason.NotSelected ? EdgeMark.NotSelected : EdgeMark.Skipped;
            }
        }

        private static int[] EndsOf(IReadOnlyList<EdgeVerdict> verdicts, EdgeMark mark)
        {
            var vertices = new List<int>();
            foreach (var verdict in verdicts)
            {
                if (MarkOf(verdict) != mark) { continue; }
                vertices.Add(verdict.FirstVertex);
                vertices.Add(verdict.SecondVertex);
            }
            return vertices.ToArray();
        }
    }
}
