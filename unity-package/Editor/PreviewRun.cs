using System;
using System.Collections.Generic;
using System.Threading;
using Chamfer;
using Chamfer.Streams;

namespace ChamferEditor
{
    /// <summary>
    /// A preview in three parts: what it needs is read on the main thread, the work may be done on another, and what
    /// came of it is put into the scene on the main thread again.
    /// </summary>
    internal sealed class PreviewRun
    {
        private readonly ModifierRun run;
        private readonly ChamferSettings settings;
        private readonly bool keepsVerdicts;
        private readonly SceneArrays scene;
        private readonly CancellationTokenSource cancellation = new CancellationTokenSource();
        private readonly List<string> failures = new List<string>();
        private List<SceneResult> results = new List<SceneResult>();

        /// <summary>Reads what is needed. A preview does not look for light: that takes too long for a drag.</summary>
        internal PreviewRun(ChamferModifier modifier)
        {
            Modifier = modifier;
            settings = modifier.Effective;
            if (settings.verify == VerifyMode.Seen) { settings.verify = VerifyMode.Full; }
            keepsVerdicts = modifier.showEdges;
            run = new ModifierRun(modifier, settings);
            if (!IsDone) { scene = SceneRun.Read(run.Scene.Objects, PreviewSources.Read, (why, mesh) => failures.Add(why)); }
        }

        internal ChamferModifier Modifier { get; }

        /// <summary>One sentence for each mesh that could not be chamfered.</summary>
        internal IReadOnlyList<string> Failures => failures;

        /// <summary>Whether there is nothing to work on: somebody else made all of it already.</summary>
        internal bool IsDone => run.IsShared;

        internal bool IsCancelled => cancellation.IsCancellationRequested;

        /// <summary>Nobody wants it any more: the work ends soon, and is not to be finished.</summary>
        internal void Cancel()
        {
            cancellation.Cancel();
        }

        /// <summary>Chamfers, on any thread.</summary>
        internal void Work()
        {
            if (IsDone) { return; }
            try { results = SceneRun.Run(scene, settings, null, cancellation.Token, (why, mesh) => failures.Add(why), keepsVerdicts); }
            catch (OperationCanceledException) { }
        }

        /// <summary>
        /// Puts into the scene what came of it; what is gone meanwhile is left out. Where nothing came of it, such as
        /// of a width that makes no sense, all stays as it was.
        /// </summary>
        internal void Finish()
        {
            if (results.Count > 0 || IsDone) { run.Apply(results); }
        }
    }
}
