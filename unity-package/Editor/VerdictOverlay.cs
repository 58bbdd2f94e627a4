using System.Collections.Generic;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Hard edges in the scene view, in the colour of what became of them.</summary>
    internal static class VerdictOverlay
    {
        internal static void Draw(ChamferModifier modifier)
        {
            foreach (var entry in modifier.meshes)
            {
                if (entry.report == null || entry.holder == null || entry.original == null) { continue; }
                if (!entry.original.isReadable) { continue; }
                Handles.matrix = entry.holder.transform.localToWorldMatrix;
                DrawEdges(entry.original.vertices, entry.report.Verdicts);
            }
            Handles.matrix = Matrix4x4.identity;
        }

        internal static Color ColorOf(EdgeOutcome outcome)
        {
            switch (outcome)
            {
                case EdgeOutcome.Full: return Color.green;
                case EdgeOutcome.Narrowed: return Color.yellow;
                default: return Color.red;
            }
        }

        private static void DrawEdges(Vector3[] positions, IReadOnlyList<EdgeVerdict> verdicts)
        {
            foreach (var outcome in new[] { EdgeOutcome.Full, EdgeOutcome.Narrowed, EdgeOutcome.Skipped })
            {
                Handles.color = ColorOf(outcome);
                Handles.DrawLines(Segments(positions, verdicts, outcome));
            }
        }

        internal static Vector3[] Segments(Vector3[] positions, IReadOnlyList<EdgeVerdict> verdicts, EdgeOutcome outcome)
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
