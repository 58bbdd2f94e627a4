using System;
using System.Linq;
using System.Text;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>What the inspector says about the meshes of a modifier.</summary>
    internal static class ReportText
    {
        internal const string OutOfDate = "Out of date: a source mesh, its scale or the preset has changed since. Press Chamfer, or "
            + "choose Tools > Chamfer All Again in Open Scenes";

        internal const string EdgesUnknown = "The edges are not known any more: press Chamfer to see them";

        /// <summary>Of all meshes of a modifier, as it was written when they were chamfered.</summary>
        internal static string Of(ChamferModifier modifier)
        {
            var known = modifier.meshes.Where(entry => entry.original != null);
            string text = string.Join("\n", known.Select(entry => entry.original.name + ": " + entry.report));
            bool isPreview = modifier.meshes.Any(entry => entry.settings.verify != modifier.Effective.verify);
            return isPreview ? text + "\nThis is a preview that nobody has looked through: press Chamfer" : text;
        }

        /// <summary>Of one mesh.</summary>
        internal static string Of(ChamferReport report)
        {
            var text = new StringBuilder();
            text.Append(report.VerticesBefore).Append(" -> ").Append(report.VerticesAfter).Append(" vertices, ");
            text.Append(report.TrianglesBefore).Append(" -> ").Append(report.TrianglesAfter).Append(" triangles; ");
            text.Append(report.HardEdges).Append(" hard edges, ").Append(report.Chamfered).Append(" full");
            AppendReasons(text, report, EdgeOutcome.Narrowed, "narrowed");
            AppendReasons(text, report, EdgeOutcome.Skipped, "skipped");
            return text.ToString();
        }

        private static void AppendReasons(StringBuilder text, ChamferReport report, EdgeOutcome outcome, string name)
        {
            foreach (EdgeReason reason in Enum.GetValues(typeof(EdgeReason)))
            {
                int count = report.Count(outcome, reason);
                if (count == 0) { continue; }
                text.Append("\n  ").Append(count).Append(' ').Append(name).Append(": ").Append(Reason(reason));
            }
        }

        private static string Reason(EdgeReason reason)
        {
            switch (reason)
            {
                case EdgeReason.NoRoom: return "a face beside has no room";
                case EdgeReason.Folds: return "the chamfer would fold";
                case EdgeReason.Miter: return "the corner is too sharp";
                case EdgeReason.Intersects: return "the chamfer would cut through the mesh";
                case EdgeReason.NoEnd: return "both ends lie inside smooth areas or on borders";
                case EdgeReason.ZeroThickness: return "the faces lie back to back";
                case EdgeReason.NoArea: return "a triangle beside has no area";
                case EdgeReason.TooFine: return "the width is too small for the precision here";
                case EdgeReason.Contact: return "something rests there, light would show behind a chamfer";
                case EdgeReason.NotSelected: return "not selected by the settings under Edges";
                case EdgeReason.TJunction: return "a vertex of one side lies in the middle of the other";
                case EdgeReason.Winding: return "a face beside is inside out";
                default: return "no reason known";
            }
        }
    }
}
