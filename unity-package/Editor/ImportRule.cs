using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>Whether and how a model is chamfered when it is imported.</summary>
    internal static class ImportRule
    {
        private const string Label = "Chamfer";

        /// <summary>
        /// The settings for a model; false if it is left alone. A label goes before rules, a nearer folder before one
        /// further up, and of two rules for a folder the upper one.
        /// </summary>
        /// <exception cref="FormatException">A label begins well but holds no width.</exception>
        internal static bool TryFind(
            ModelFacts model,
            ChamferSettings common,
            IEnumerable<ModelRule> rules,
            out ChamferSettings settings)
        {
            foreach (string label in model.Labels)
            {
                if (TryParse(label, common, out settings)) { return true; }
            }
            // Sorting keeps the order of equals.
            var concerned = rules.Where(rule => rule.Concerns(model));
            var nearest = concerned.OrderByDescending(rule => rule.Folder.Length).Take(1).ToList();
            settings = common;
            if (nearest.Count == 0 || nearest[0].exclude) { return false; }
            // A rule that was just added to the list holds zeros.
            if (nearest[0].settings.width != 0) { settings = nearest[0].settings; }
            return true;
        }

        /// <summary>Whether a label is about chamfering.</summary>
        internal static bool IsLabel(string label)
        {
            return string.Equals(label, Label, StringComparison.OrdinalIgnoreCase)
                || label.StartsWith(Label + "=", StringComparison.OrdinalIgnoreCase);
        }

        /// <summary>The label that asks for the width of the settings.</summary>
        internal static string LabelOf(ChamferSettings settings)
        {
            string unit = settings.unit == WidthUnit.PercentOfExtent ? "%" : "";
            string rounding = settings.segments > 1 ? "," + settings.segments : "";
            return Label + "=" + SettingsText.Number(settings.width) + unit + rounding;
        }

        /// <summary>
        /// Reads <c>Chamfer</c>, <c>Chamfer=0.02</c> (mesh units) or <c>Chamfer=2%</c>, each width with segments behind it
        /// or without: <c>Chamfer=2%,3</c>.
        /// </summary>
        private static bool TryParse(string label, ChamferSettings common, out ChamferSettings settings)
        {
            settings = common;
            if (!IsLabel(label)) { return false; }
            if (label.Length == Label.Length) { return true; }
            string[] parts = label.Substring(Label.Length + 1).Split(',');
            string width = parts[0].Trim();
            bool hasSegments = parts.Length == 1 || HasSegments(parts, ref settings);
            bool isPercent = width.EndsWith("%", StringComparison.Ordinal);
            settings.unit = isPercent ? WidthUnit.PercentOfExtent : WidthUnit.MeshUnits;
            bool hasWidth = float.TryParse(
                width.TrimEnd('%'), NumberStyles.Float, CultureInfo.InvariantCulture, out settings.width);
            if (hasWidth && hasSegments)
            {
                return true;
            }
            throw new FormatException("The label '" + label + "' holds no width: write Chamfer=0.02 or Chamfer=2%, or Chamfer=2%,3 for three segments");
        }

        private static bool HasSegments(string[] parts, ref ChamferSettings settings)
        {
            return parts.Length == 2
                && int.TryParse(parts[1].Trim(), NumberStyles.None, CultureInfo.InvariantCulture, out settings.segments)
                && settings.segments >= 1 && settings.segments <= ChamferSettings.MostSegments;
        }
    }
}
