using System;
using System.Diagnostics;
using System.Threading;
using Chamfer.Interop;

namespace Chamfer.Streams
{
    /// <summary>
    /// A mesh with all that is known of it before anybody asks for a width. It never changes, and any thread may use
    /// it.
    /// </summary>
    internal sealed class PreparedMesh : IDisposable
    {
        private readonly MeshArrays source;
        private readonly PreparedHandle handle;

        internal PreparedMesh(MeshArrays source)
        {
            LibraryCheck.Require();
            this.source = source;
            using (var pins = new PinnedArrays())
            {
                var mesh = NativeInput.Mesh(source, pins);
                var error = NativeError.Empty();
                int status = NativeMethods.Prepare(ref mesh, out handle, ref error);
                if (status != NativeStatus.Ok) { throw Failure.Of(status, error, source.Name, CancellationToken.None); }
            }
        }

        internal MeshArrays Source => source;

        internal PreparedHandle Handle => handle;

        /// <summary>As <see cref="ArrayChamfer.Run"/>, sooner.</summary>
        /// <param name="settings">How.</param>
        /// <param name="keepsVerdicts">Whether somebody asks for each edge by itself.</param>
        internal ArrayResult Run(ChamferSettings settings, bool keepsVerdicts)
        {
            SettingsCheck.Require(source, settings);
            var watch = Stopwatch.StartNew();
            var options = NativeInput.Options(settings);
            var error = NativeError.Empty();
            ResultHandle result;
            int status = NativeMethods.PreparedRun(handle, ref options, null, IntPtr.Zero, out result, ref error);
            using (result)
            {
                if (status != NativeStatus.Ok) { throw Failure.Of(status, error, source.Name, CancellationToken.None); }
                return ArrayChamfer.Finish(source, result, watch.Elapsed, keepsVerdicts);
            }
        }

        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
