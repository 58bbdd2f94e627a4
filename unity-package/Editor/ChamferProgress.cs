using System;
using System.Diagnostics;
using System.Threading;
using UnityEditor;

namespace ChamferEditor
{
    /// <summary>A progress bar over several scenes, whose button cancels.</summary>
    internal sealed class ChamferProgress : IProgress<float>, IDisposable
    {
        private readonly CancellationTokenSource source = new CancellationTokenSource();
        private readonly Stopwatch watch = Stopwatch.StartNew();
        private readonly double patience;
        private readonly int scenes;
        private string scene = "";
        private int begun;

        /// <param name="scenes">How many there will be.</param>
        /// <param name="patience">Milliseconds without a bar: it would flicker while a slider is dragged.</param>
        internal ChamferProgress(int scenes, double patience)
        {
            this.patience = patience;
            this.scenes = scenes;
        }

        internal CancellationToken Cancellation => source.Token;

        internal void Begin(string name)
        {
            scene = name;
            begun++;
            Report(0);
        }

        public void Report(float done)
        {
            if (watch.Elapsed.TotalMilliseconds < patience) { return; }
            float share = (begun - 1 + done) / scenes;
            if (EditorUtility.DisplayCancelableProgressBar("Chamfer", scene, share)) { source.Cancel(); }
        }

        public void Dispose()
        {
            EditorUtility.ClearProgressBar();
            source.Dispose();
        }
    }
}
