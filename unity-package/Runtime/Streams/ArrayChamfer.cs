using System;
using System.Diagnostics;
using System.Threading;
using Chamfer.Interop;

namespace Chamfer.Streams
{
    /// <summary>What <see cref="ArrayChamfer"/> makes.</summary>
    internal struct ArrayResult
    {
        public MeshArrays Mesh;
        public ChamferReport Report;
    }

    /// <summary>Chamfers arrays, on any thread.</summary>
    internal static class ArrayChamfer
    {
        internal static ArrayResult Run(
            MeshArrays source,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation)
        {
            LibraryCheck.Require();
            SettingsCheck.Require(source, settings);
            cancellation.ThrowIfCancellationRequested();
            var watch = Stopwatch.StartNew();
            using (var result = Call(source, settings, progress, cancellation))
            {
                return Finish(source, result, watch.Elapsed, true);
            }
        }

        /// <summary>Copies a native result, and carries along what the library does not know of.</summary>
        internal static ArrayResult Finish(MeshArrays source, ResultHandle result, TimeSpan took, bool keepsVerdicts)
        {
            var output = ResultReader.Mesh(result, source);
            // The library makes them when they are asked for, and that costs time.
            if (NeedsSources(source)) { Carry(source, output, ResultReader.VertexSources(result)); }
            else { output.Skin = source.Skin; }
            var report = ResultReader.Report(result, source, output, keepsVerdicts);
            report.Milliseconds = took.TotalMilliseconds;
            return new ArrayResult { Mesh = output, Report = report };
        }

        private static bool NeedsSources(MeshArrays source)
        {
            bool hasBones = source.Skin != null && source.Skin.BonesPerVertex.Length > 0;
            return hasBones || source.BlendShapes.Length > 0 || Array.Exists(source.Submeshes, one => !one.IsTriangles);
        }

        private static void Carry(MeshArrays source, MeshArrays output, NativeVertexSource[] known)
        {
            var sources = Passthrough.Restore(source, output, known);
            output.Skin = SkinCarrier.Carry(source.Skin, sources);
            output.BlendShapes = BlendShapeCarrier.Carry(source.BlendShapes, sources);
        }

        private static ResultHandle Call(
            MeshArrays source,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation)
        {
            using (var pins = new PinnedArrays())
            using (var relay = new ProgressRelay(progress, cancellation))
            {
                var mesh = NativeInput.Mesh(source, pins, MeshFactors.Of(source, settings.edges, null));
                var options = NativeInput.Options(settings);
                var error = NativeError.Empty();
                ResultHandle result;
                int status = NativeMethods.Run(
                    ref mesh, ref options, ProgressRelay.Callback, relay.User, out result, ref error);
                if (status == NativeStatus.Ok) { return result; }
                result.Dispose();
                relay.Rethrow();
                throw Failure.Of(status, error, source.Name, cancellation);
            }
        }
    }
}
