using System;
using System.Collections.Generic;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What became of the hard edges of a mesh, and where they are.</summary>
    internal sealed class MeshVerdicts
    {
        private readonly Vector3[][] segments;

        /// <param name="positions">Those of the source, which need not be readable any more.</param>
        /// <param name="report">About the source's edges.</param>
        /// <param name="settings">What the mesh was made with.</param>
        internal MeshVerdicts(Vector3[] positions, ChamferReport report, ChamferSettings settings)
        {
            Report = report;
            Settings = settings;
            segments = new Vector3[Enum.GetValues(typeof(EdgeOutcome)).Length][];
            for (int outcome = 0; outcome < segments.Length; outcome++)
            {
                segments[outcome] = Lines(positions, report.Verdicts, (EdgeOutcome)outcome);
            }
        }

        internal ChamferReport Report { get; }

        internal ChamferSettings Settings { get; }

        /// <summary>Two points for each edge with that outcome.</summary>
        internal Vector3[] Segments(EdgeOutcome outcome)
        {
            return segments[(int)outcome];
        }

        private static Vector3[] Lines(Vector3[] positions, IReadOnlyList<EdgeVerdict> verdicts, EdgeOutcome outcome)
        {
            var ends = new List<Vector3>();
            foreach (var verdict in verdicts)
            {
                if (verdict.Outcome != outcome) { continue; }
                ends.Add(positions[verdict.FirstVertex]);
                ends.Add(positions[verdict.SecondVertex]);
            }
            return ends.ToArray();
        }
    }
}
