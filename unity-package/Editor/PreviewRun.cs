using System;
using System.Collections.Generic;
using System.Threading;
using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// A preview in three parts: what it needs is read on the main thread, the work may be done on another, and what
    /// came of it is put into the scene on the main thread again.
    /// </summary>
    internal sealed class PreviewRun
    {
        private readonly ModifierRun run;
        private readonly List<string> failures = new List<string>();
        private readonly Func<List<SceneResult>> work;
        private List<SceneResult> results = new List<SceneResult>();

        /// <summary>Reads what is needed. A preview does not look for light: that takes too long for a drag.</summary>
        internal PreviewRun(ChamferModifier modifier)
        {
            Modifier = modifier;
            var settings = modifier.Effective;
            if (settings.verify == VerifyMode.Seen) { settings.verify = VerifyMode.Full; }
            run = new ModifierRun(modifier, settings);
            work = run.IsShared ? () => new List<SceneResult>() : WorkFor(settings, modifier.showEdges);
        }

        internal ChamferModifier Modifier { get; }

        /// <summary>One sentence for each mesh that could not be chamfered.</summary>
        internal IReadOnlyList<string> Failures => failures;

        /// <summary>Chamfers, on any thread.</summary>
        internal void Work()
        {
            try { results = work(); }
            catch (ChamferException exception) { failures.Add(exception.Message); }
        }

        /// <summary>Whether there is nothing to work on: somebody else made all of it already.</summary>
        internal bool IsDone => run.IsShared;

        /// <summary>
        /// Puts into the scene what came of it; what is gone meanwhile is left out. Where nothing came of it, such as
        /// of a width that makes no sense, all stays as it was.
        /// </summary>
        internal void Finish()
        {
            if (Modifier != null && (results.Count > 0 || IsDone)) { run.Apply(results); }
        }

        private Func<List<SceneResult>> WorkFor(ChamferSettings settings, bool keepsVerdicts)
        {
            try
            {
                if (run.Scene.Objects.Count == 1) { return Alone(run.Scene.Objects[0].Mesh, settings, keepsVerdicts); }
            }
            catch (ChamferException exception)
            {
                failures.Add(exception.Message);
                return () => new List<SceneResult>();
            }
            var scene = SceneRun.Read(run.Scene.Objects, PreviewSources.Read, (why, mesh) => failures.Add(why));
            return () => SceneRun.Run(scene, settings, null, CancellationToken.None, (why, mesh) => failures.Add(why));
        }

        private static Func<List<SceneResult>> Alone(Mesh mesh, ChamferSettings settings, bool keepsVerdicts)
        {
            var prepared = PreviewSources.Prepare(mesh);
            return () => new List<SceneResult>
            {
                new SceneResult { Mesh = mesh, Source = prepared.Source, Output = prepared.Run(settings, keepsVerdicts) }
            };
        }
    }
}
