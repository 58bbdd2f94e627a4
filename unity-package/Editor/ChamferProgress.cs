using System;
using System.Diagnostics;
using System.Threading;
using UnityEditor;

namespace ChamferEditor
{
    /// <summary>A progress bar over several meshes, whose button cancels.</summary>
    internal sealed class ChamferProgress : IProgress<float>, IDisposable
    {
        private readonly CancellationTokenSource source = new CancellationTokenSource();
        private readonly Stopwatch watch = Stopwatch.StartNew();
        private readonly double patience;
        private readonly int meshes;
        private string mesh = "";
        private int begun;

        /// <param name="meshes">How many there will be.</param>
        /// <param name="patience">Milliseconds without a bar: it would flicker while a slider is dragged.</param>
        internal ChamferProgress(int meshes, double patience)
        {
            this.patience = patience;
            this.meshes = meshes;
        }

        internal CancellationToken Cancellation => source.Token;

        internal void Begin(string name)
        {
            mesh = name;
            begun++;
            Report(0);
        }

        public void Report(float done)
        {
            if (watch.Elapsed.TotalMilliseconds < patience) { return; }
            float share = (begun - 1 + done) / meshes;
            if (EditorUtility.DisplayCancelableProgressBar("Chamfer", mesh, share)) { source.Cancel(); }
        }

        public void Dispose()
        {
            EditorUtility.ClearProgressBar();
            source.Dispose();
        }
    }
}
