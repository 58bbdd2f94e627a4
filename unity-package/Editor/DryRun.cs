using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What importing a model again would do to it.</summary>
    internal enum ImportOutcome
    {
        Same,
        Chamfered,
        ChamferedOtherwise,
        LeftAlone,
        Failed
    }

    /// <summary>A model, and what rules and labels would do to it now.</summary>
    internal struct DryRunRow
    {
        internal string Path;
        internal ImportOutcome Outcome;
        internal string Text;
    }

    /// <summary>Tries the rules of the project without importing anything.</summary>
    internal static class DryRun
    {
        /// <summary>All models that would change, by path; null if the user cancelled.</summary>
        internal static List<DryRunRow> Run(ChamferProjectSettings project)
        {
            var rows = new List<DryRunRow>();
            var paths = AssetDatabase.FindAssets("t:Model").Select(guid => AssetDatabase.GUIDToAssetPath(guid));
            foreach (string path in paths.Distinct().OrderBy(path => path, StringComparer.Ordinal))
            {
                DryRunRow row;
                if (!TryModel(path, project, out row)) { return null; }
                if (row.Outcome != ImportOutcome.Same) { rows.Add(row); }
            }
            return rows;
        }

        /// <summary>How many models would be what, in words.</summary>
        internal static string Summary(IReadOnlyCollection<DryRunRow> rows)
        {
            if (rows.Count == 0) { return "No model would change."; }
            var parts = new[]
            {
                Count(rows, ImportOutcome.Chamfered, "would be chamfered"),
                Count(rows, ImportOutcome.ChamferedOtherwise, "would be chamfered otherwise than now"),
                Count(rows, ImportOutcome.LeftAlone, "would be left alone again"),
                Count(rows, ImportOutcome.Failed, "could not be chamfered")
            };
            return string.Join(", ", parts.Where(part => part != null)) + ".";
        }

        private static string Count(IEnumerable<DryRunRow> rows, ImportOutcome outcome, string text)
        {
            int count = rows.Count(row => row.Outcome == outcome);
            return count == 0 ? null : (count == 1 ? "1 model " : count + " models ") + text;
        }

        private static bool TryModel(string path, ChamferProjectSettings project, out DryRunRow row)
        {
            row = new DryRunRow { Path = path };
            var record = AssetDatabase.LoadAssetAtPath<ChamferRecord>(path);
            var root = AssetDatabase.LoadMainAssetAtPath(path) as GameObject;
            var slots = root != null ? MeshSlot.In(root, true) : new List<MeshSlot>();
            var facts = ModelFacts.At(path);
            // What is chamfered has other triangles than the file.
            facts = record != null ? facts.With(record) : facts.With(slots.Select(slot => slot.Mesh));
            try
            {
                ChamferSettings settings;
                if (!ImportRule.TryFind(facts, project.settings, project.rules, out settings)) { row = LeftAlone(row, record); }
                else if (record != null) { row = Otherwise(row, record, settings); }
                else { return slots.Count == 0 || TryChamfer(MeshScene.Of(root.transform, slots), settings, ref row); }
            }
            catch (FormatException exception)
            {
                row.Outcome = ImportOutcome.Failed;
                row.Text = exception.Message;
            }
            return true;
        }

        private static DryRunRow LeftAlone(DryRunRow row, ChamferRecord record)
        {
            if (record == null) { return row; }
            row.Outcome = ImportOutcome.LeftAlone;
            row.Text = "now: " + SettingsText.Words(record.settings);
            return row;
        }

        private static DryRunRow Otherwise(DryRunRow row, ChamferRecord record, ChamferSettings settings)
        {
            if (SettingsText.Of(record.settings) == SettingsText.Of(settings)) { return row; }
            row.Outcome = ImportOutcome.ChamferedOtherwise;
            row.Text = "now: " + SettingsText.Words(record.settings) + "; then: " + SettingsText.Words(settings);
            return row;
        }

        private static bool TryChamfer(MeshScene scene, ChamferSettings settings, ref DryRunRow row)
        {
            var job = new ChamferJob();
            if (!job.Run(new[] { scene }, settings)) { return false; }
            var summary = new JobSummary();
            summary.Add(job);
            bool changes = job.Results.Values.Any(result => result.HasChanged);
            row.Outcome = summary.HasFailed ? ImportOutcome.Failed : changes ? ImportOutcome.Chamfered : ImportOutcome.Same;
            int before = job.Results.Values.Sum(result => result.Report.TrianglesBefore);
            int after = job.Results.Values.Sum(result => result.Report.TrianglesAfter);
            row.Text = SettingsText.Words(settings) + "; " + before + " -> " + after + " triangles; " + summary;
            return true;
        }
    }
}
