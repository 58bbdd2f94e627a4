using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading;
using AOT;

namespace Chamfer.Interop
{
    /// <summary>
    /// Hands native progress on to the caller. Exceptions must not pass through native frames: they
    /// cancel the call and are thrown again after it.
    /// </summary>
    internal sealed class ProgressRelay : IDisposable
    {
        /// <summary>Kept here, so that the collector cannot take it during a call.</summary>
        internal static readonly NativeProgress Callback = OnProgress;

        private readonly IProgress<float> progress;
        private readonly CancellationToken cancellation;
        private GCHandle self;
        private ExceptionDispatchInfo thrown;

        internal ProgressRelay(IProgress<float> progress, CancellationToken cancellation)
        {
            this.progress = progress;
            this.cancellation = cancellation;
            self = GCHandle.Alloc(this);
        }

        internal IntPtr User => GCHandle.ToIntPtr(self);

        internal void Rethrow()
        {
            if (thrown != null) { thrown.Throw(); }
        }

        public void Dispose()
        {
            self.Free();
        }

        [MonoPInvokeCallback(typeof(NativeProgress))]
        private static int OnProgress(IntPtr user, float done)
        {
            return ((ProgressRelay)GCHandle.FromIntPtr(user).Target).Report(done) ? 0 : 1;
        }

        /// <summary>Whether to go on.</summary>
        private bool Report(float done)
        {
            try
            {
                if (progress != null) { progress.Report(done); }
                return !cancellation.IsCancellationRequested;
            }
            catch (Exception exception)
            {
                thrown = ExceptionDispatchInfo.Capture(exception);
                return false;
            }
        }
    }
}
