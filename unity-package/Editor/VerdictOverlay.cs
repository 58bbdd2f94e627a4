using Chamfer;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;

namespace ChamferEditor
{
    /// <summary>Hard edges in the scene view, in the colour of what became of them; faint where something is before.</summary>
    internal static class VerdictOverlay
    {
        /// <summary>Enough to find an edge on the far side, without taking it for one on this side.</summary>
        private const float Faint = 0.15f;

        private static readonly EdgeMark[] marks =
        {
            EdgeMark.NotSelected, EdgeMark.Full, EdgeMark.Narrowed, EdgeMark.Skipped
        };

        internal static void Draw(ChamferModifier modifier)
        {
            var before = Handles.zTest;
            try
            {
                foreach (var entry in modifier.meshes) { Draw(entry); }
            }
            finally { Handles.zTest = before; }
        }

        private static void Draw(ChamferedMesh entry)
        {
            var verdicts = VerdictCache.Of(entry);
            if (verdicts == null || entry.holder == null) { return; }
            foreach (var mark in marks)
            {
                var posed = PosedEdges.Of(verdicts, mark, entry.holder);
                var place = posed != null ? Matrix4x4.identity : entry.holder.transform.localToWorldMatrix;
                Draw(posed ?? verdicts.Segments(mark), place, ColorOf(mark));
            }
        }

        private static void Draw(Vector3[] lines, Matrix4x4 place, Color color)
        {
            Draw(lines, place, color, CompareFunction.LessEqual);
            color.a = Faint;
            Draw(lines, place, color, CompareFunction.Greater);
        }

        private static void Draw(Vector3[] lines, Matrix4x4 place, Color color, CompareFunction test)
        {
            using (new Handles.DrawingScope(color, place))
            {
                Handles.zTest = test;
                Handles.DrawLines(lines);
            }
        }

        private static Color ColorOf(EdgeMark mark)
        {
            switch (mark)
            {
                case EdgeMark.Full: return Color.green;
                case EdgeMark.Narrowed: return Color.yellow;
                case EdgeMark.NotSelected: return Color.gray;
                default: return Color.red;
            }
        }
    }
}
