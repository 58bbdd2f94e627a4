using System;
using System.Collections.Generic;
using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Chamfers many meshes, each once. No mesh is made or changed before all are through, so that cancelling
    /// leaves nothing behind.
    /// </summary>
    internal sealed class ChamferJob
    {
        private readonly double patience;
        private readonly Dictionary<Mesh, JobResult> results = new Dictionary<Mesh, JobResult>();
        private readonly List<string> failures = new List<string>();

        /// <param name="patience">Milliseconds before a progress bar appears.</param>
        internal ChamferJob(double patience = 0)
        {
            this.patience = patience;
        }

        /// <summary>What came of each mesh that could be chamfered.</summary>
        internal IReadOnlyDictionary<Mesh, JobResult> Results => results;

        /// <summary>One sentence for each mesh that could not.</summary>
        internal IReadOnlyList<string> Failures => failures;

        /// <summary>False if the user cancelled; then there are no results.</summary>
        internal bool Run(IEnumerable<Mesh> meshes, ChamferSettings settings)
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
                    results.Clear();
                    return false;
                }
            }
        }

        private void RunOne(Mesh mesh, ChamferSettings settings, ChamferProgress progress)
        {
            progress.Begin(mesh.name);
            try
            {
                var source = MeshReader.Read(mesh);
                var output = ArrayChamfer.Run(source, settings, progress, progress.Cancellation);
                output.Mesh.Name = mesh.name + JobResult.Suffix;
                results.Add(mesh, new JobResult(source.Positions, settings, output));
            }
            catch (ChamferException exception) { failures.Add(exception.Message); }
        }
    }
}
