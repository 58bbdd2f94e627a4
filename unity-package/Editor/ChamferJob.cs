using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Chamfers the meshes of several scenes, each once. No mesh is made or changed before all are through, so that
    /// cancelling leaves nothing behind.
    /// </summary>
    internal sealed class ChamferJob
    {
        private readonly double patience;
        private readonly Dictionary<Mesh, JobResult> results = new Dictionary<Mesh, JobResult>();
        private readonly HashSet<Mesh> failed = new HashSet<Mesh>();
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
        /// <param name="scenes">A mesh of several is the result of the first.</param>
        /// <param name="settings">How.</param>
        internal bool Run(IReadOnlyList<MeshScene> scenes, ChamferSettings settings)
        {
            using (var progress = new ChamferProgress(scenes.Count, patience))
            {
                try
                {
                    foreach (var scene in scenes) { RunOne(scene, settings, progress); }
                    return true;
                }
                catch (OperationCanceledException)
                {
                    results.Clear();
                    return false;
                }
            }
        }

        private void RunOne(MeshScene scene, ChamferSettings settings, ChamferProgress progress)
        {
            progress.Begin(scene.Name);
            if (scene.Wanted.All(IsKnown)) { return; }
            foreach (var result in SceneRun.Run(scene.Objects, settings, progress, progress.Cancellation, Fail))
            {
                if (IsKnown(result.Mesh) || !scene.Wanted.Contains(result.Mesh)) { continue; }
                results.Add(result.Mesh, new JobResult(result, settings, scene.KeyOf(result.Mesh, settings)));
            }
        }

        private bool IsKnown(Mesh mesh)
        {
            return results.ContainsKey(mesh) || failed.Contains(mesh);
        }

        private void Fail(string why, Mesh mesh)
        {
            if (mesh == null || failed.Add(mesh)) { failures.Add(why); }
        }
    }
}
