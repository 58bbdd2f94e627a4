using System;
using System.Collections.Generic;
using Chamfer;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>Chamfers many meshes, each once. Nothing but its own results changes.</summary>
    internal sealed class ChamferJob
    {
        private readonly double patience;
        private readonly Dictionary<Mesh, ChamferResult> results = new Dictionary<Mesh, ChamferResult>();
        private readonly List<string> failures = new List<string>();

        /// <param name="patience">Milliseconds before a progress bar appears.</param>
        internal ChamferJob(double patience = 0)
        {
            this.patience = patience;
        }

        /// <summary>What came of each mesh that could be chamfered.</summary>
        internal IReadOnlyDictionary<Mesh, ChamferResult> Results => results;

        /// <summary>One sentence for each mesh that could not.</summary>
        internal IReadOnlyList<string> Failures => failures;

        /// <summary>False if the user cancelled; then there are no results.</summary>
        internal bool Run(ICollection<Mesh> meshes, ChamferSettings settings)
        {
            var distinct = new HashSet<Mesh>(meshes);
            using (var progress = new ChamferProgress(distinct.Count, patience))
            {
                try
                {
                    foreach (var mesh in distinct) { RunOne(mesh, settings, progress); }
                    return true;
                }
                catch (OperationCanceledException)
                {
                    Discard();
                    return false;
                }
            }
        }

        internal string Summary()
        {
            int chamfered = 0, narrowed = 0, skipped = 0;
            foreach (var result in results.Values)
            {
                chamfered += result.Report.Chamfered;
                narrowed += result.Report.Narrowed;
                skipped += result.Report.Skipped;
            }
            string summary = results.Count + " meshes: " + chamfered + " edges chamfered, " + narrowed + " narrowed, "
                + skipped + " skipped";
            return failures.Count == 0 ? summary : summary + "\n" + string.Join("\n", failures);
        }

        private void RunOne(Mesh mesh, ChamferSettings settings, ChamferProgress progress)
        {
            progress.Begin(mesh.name);
            try
            {
                var result = MeshChamfer.Run(mesh, settings, progress, progress.Cancellation);
                result.Mesh.name = mesh.name + " Chamfered";
                results.Add(mesh, result);
            }
            catch (ChamferException exception) { failures.Add(exception.Message); }
        }

        private void Discard()
        {
            foreach (var result in results.Values) { Object.DestroyImmediate(result.Mesh); }
            results.Clear();
        }
    }
}
