using System;
using System.Linq;
using System.Text.RegularExpressions;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Which models are chamfered when they are imported, and how. What is left empty holds for all.</summary>
    [Serializable]
    internal struct ModelRule
    {
        [Tooltip("Such as Assets/Models. A nearer folder goes before one further up.")]
        public string folder;

        [Tooltip("An asset label that models must have.")]
        public string label;

        [Tooltip("What the name of the file has to be, with * for anything: *_low")]
        public string pattern;

        [Tooltip("Models with fewer triangles are left to other rules; 0 for no limit.")]
        public int fewestTriangles;

        [Tooltip("Models with more triangles are left to other rules; 0 for no limit.")]
        public int mostTriangles;

        [Tooltip("Models whose largest side is shorter are left to other rules; 0 for no limit.")]
        public float smallestSize;

        [Tooltip("Models whose largest side is longer are left to other rules; 0 for no limit.")]
        public float largestSize;

        [Tooltip("Leave these models as they are.")]
        public bool exclude;

        [Tooltip("Settings that others share; they go before those below.")]
        public ChamferPreset preset;

        [Tooltip("At width 0, the settings for all models count.")]
        public ChamferSettings settings;

        /// <summary>Without a slash at its end, which users may write; never null.</summary>
        internal string Folder => (folder ?? "").TrimEnd('/');

        /// <summary>Whether a model lies where the rule holds, and is called so.</summary>
        internal bool CanConcern(ModelFacts model)
        {
            bool isInside = Folder.Length == 0 || model.Path.StartsWith(Folder + "/", StringComparison.Ordinal);
            bool hasLabel = string.IsNullOrEmpty(label) || model.Labels.Contains(label, StringComparer.OrdinalIgnoreCase);
            // A rule that was just added to the list says nothing yet.
            return !IsEmpty && isInside && hasLabel && IsNamed(model.Name);
        }

        /// <summary>Whether the rule holds for a model.</summary>
        internal bool Concerns(ModelFacts model)
        {
            return CanConcern(model) && IsWithin(model.Triangles, fewestTriangles, mostTriangles)
                && IsWithin(model.Size, smallestSize, largestSize);
        }

        /// <summary>All that the rule says.</summary>
        internal string Text()
        {
            return string.Join("|", new[]
            {
                Folder, label ?? "", pattern ?? "", fewestTriangles.ToString(), mostTriangles.ToString(),
                SettingsText.Number(smallestSize), SettingsText.Number(largestSize), exclude.ToString(),
                SettingsText.Of(settings)
            });
        }

        private bool IsEmpty => Folder.Length == 0 && string.IsNullOrEmpty(label) && string.IsNullOrEmpty(pattern);

        private bool IsNamed(string name)
        {
            if (string.IsNullOrEmpty(pattern)) { return true; }
            string expression = "^" + Regex.Escape(pattern).Replace("\\*", ".*").Replace("\\?", ".") + "$";
            return Regex.IsMatch(name, expression, RegexOptions.IgnoreCase | RegexOptions.CultureInvariant);
        }

        private static bool IsWithin(float value, float least, float most)
        {
            return value >= least && (most <= 0 || value <= most);
        }
    }
}
