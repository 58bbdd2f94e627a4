using System.Collections.Generic;
using System.Linq;

namespace ChamferEditor
{
    /// <summary>What jobs did, in words.</summary>
    internal sealed class JobSummary
    {
        private const string Smooth = " (all normals are smooth: where faces are to look flat, set Normals to Calculate, "
            + "with a Smoothing Angle, in the model's import settings)";

        private int meshes, without, already, chamfered, narrowed, skipped;
        private readonly List<string> notes = new List<string>();
        private readonly List<string> failures = new List<string>();

        /// <summary>Whether some mesh could not be chamfered.</summary>
        internal bool HasFailed => failures.Count > 0;

        /// <summary>One sentence for each mesh that could not be chamfered.</summary>
        internal IReadOnlyList<string> Failures => failures;

        internal void Add(ChamferJob job)
        {
            failures.AddRange(job.Failures);
            foreach (var result in job.Results.Values)
            {
                if (result.Report.Quads > 0) { notes.Add(QuadsText.Of(result.Source)); }
                if (result.Report.HardEdges == 0) { without++; continue; }
                meshes++;
                chamfered += result.Report.Chamfered;
                narrowed += result.Report.Narrowed;
                skipped += result.Report.Skipped;
            }
        }

        internal void Add(ModifierRun run)
        {
            Add(run.Job);
        }

        /// <summary>Meshes that were chamfered before, and are left as they are.</summary>
        internal void AddAlready(int count)
        {
            already += count;
        }

        /// <summary>A model that was imported again, or need not be.</summary>
        internal void AddImported(ChamferRecord record, bool isAlready)
        {
            if (record == null) { return; }
            if (isAlready) { already++; }
            else { notes.Add(record.report); }
            failures.AddRange(record.failures);
        }

        public override string ToString()
        {
            string text = Meshes(meshes) + ": " + chamfered + " edges full, " + narrowed + " narrowed, " + skipped
                + " skipped";
            if (without > 0) { text += "; " + Meshes(without) + " without hard edges left alone" + Smooth; }
            if (already > 0) { text += "; " + Meshes(already) + " chamfered already left alone"; }
            return string.Join("\n", new[] { text }.Concat(notes).Concat(failures));
        }

        private static string Meshes(int count)
        {
            return count == 1 ? "1 mesh" : count + " meshes";
        }
    }
}
