using System;
using System.Collections.Generic;
using System.Globalization;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>Whether and how a model is chamfered when it is imported.</summary>
    internal static class ImportRule
    {
        private const string Label = "Chamfer";

        /// <summary>
        /// The settings for a model; false if it is left alone. A label goes before a folder, and a nearer folder
        /// before one further up.
        /// </summary>
        /// <exception cref="FormatException">A label begins well but holds no width.</exception>
        internal static bool TryFind(
            string path,
            IEnumerable<string> labels,
            ChamferSettings common,
            IEnumerable<FolderRule> folders,
            out ChamferSettings settings)
        {
            foreach (string label in labels)
            {
                if (TryParse(label, common, out settings)) { return true; }
            }
            return TryFolder(path, common, folders, out settings);
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
            return Label + "=" + settings.width.ToString("R", CultureInfo.InvariantCulture) + unit;
        }

        /// <summary>Reads <c>Chamfer</c>, <c>Chamfer=0.02</c> (mesh units) or <c>Chamfer=2%</c>.</summary>
        private static bool TryParse(string label, ChamferSettings common, out ChamferSettings settings)
        {
            settings = common;
            if (!IsLabel(label)) { return false; }
            if (label.Length == Label.Length) { return true; }
            string width = label.Substring(Label.Length + 1).Trim();
            bool isPercent = width.EndsWith("%", StringComparison.Ordinal);
            settings.unit = isPercent ? WidthUnit.PercentOfExtent : WidthUnit.MeshUnits;
            if (float.TryParse(width.TrimEnd('%'), NumberStyles.Float, CultureInfo.InvariantCulture, out settings.width))
            {
                return true;
            }
            throw new FormatException("The label '" + label + "' holds no width: write Chamfer=0.02 or Chamfer=2%");
        }

        private static bool TryFolder(
            string path,
            ChamferSettings common,
            IEnumerable<FolderRule> folders,
            out ChamferSettings settings)
        {
            int longest = 0;
            settings = default(ChamferSettings);
            foreach (var rule in folders)
            {
                string folder = rule.Folder;
                bool isInside = path.StartsWith(folder + "/", StringComparison.Ordinal);
                if (folder.Length <= longest || !isInside) { continue; }
                longest = folder.Length;
                // A rule that was just added to the list holds zeros.
                settings = rule.settings.width == 0 ? common : rule.settings;
            }
            return longest > 0;
        }
    }
}
