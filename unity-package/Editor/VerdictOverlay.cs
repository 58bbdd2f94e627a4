using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Hard edges in the scene view, in the colour of what became of them.</summary>
    internal static class VerdictOverlay
    {
        private static readonly EdgeOutcome[] outcomes = { EdgeOutcome.Full, EdgeOutcome.Narrowed, EdgeOutcome.Skipped };

        internal static void Draw(ChamferModifier modifier)
        {
            foreach (var entry in modifier.meshes)
            {
                var verdicts = VerdictCache.Of(modifier, entry);
                if (verdicts == null || entry.holder == null) { continue; }
                foreach (var outcome in outcomes)
                {
                    using (new Handles.DrawingScope(ColorOf(outcome), entry.holder.transform.localToWorldMatrix))
                    {
                        Handles.DrawLines(verdicts.Segments(outcome));
                    }
                }
            }
        }

        private static Color ColorOf(EdgeOutcome outcome)
        {
            switch (outcome)
            {
                case EdgeOutcome.Full: return Color.green;
                case EdgeOutcome.Narrowed: return Color.yellow;
                default: return Color.red;
            }
        }
    }
}
