using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using Chamfer.Interop;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Where one of the meshes of a scene stands.</summary>
    internal struct PlacedArrays
    {
        /// <summary>Its number among the meshes.</summary>
        public int Mesh;
        public Matrix4x4 Transform;
    }

    /// <summary>Chamfers the arrays of meshes that stand together, on any thread.</summary>
    internal static class SceneChamfer
    {
        /// <summary><c>#meshes</c></summary>
        /// <exception cref="ChamferException">With the number of the mesh at fault, if it is one.</exception>
        internal static ArrayResult[] Run(
            IReadOnlyList<MeshArrays> meshes,
            IEnumerable<PlacedArrays> placed,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation)
        {
            LibraryCheck.Require();
            for (int mesh = 0; mesh < meshes.Count; mesh++) { Require(meshes[mesh], mesh, settings); }
            cancellation.ThrowIfCancellationRequested();
            var watch = Stopwatch.StartNew();
            var objects = placed.Select(one => NativeObject.Of(one.Mesh, one.Transform)).ToArray();
            var results = Call(meshes, objects, settings, progress, cancellation);
            watch.Stop();
            try { return results.Select((result, mesh) => ArrayChamfer.Finish(meshes[mesh], result, watch.Elapsed, true)).ToArray(); }
            finally { foreach (var result in results) { result.Dispose(); } }
        }

        private static void Require(MeshArrays mesh, int number, ChamferSettings settings)
        {
            try { SettingsCheck.Require(mesh, settings); }
            catch (ChamferException exception)
            {
                exception.MeshNumber = number;
                throw;
            }
        }

        private static unsafe ResultHandle[] Call(
            IReadOnlyList<MeshArrays> meshes,
            NativeObject[] objects,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation)
        {
            using (var pins = new PinnedArrays())
            using (var relay = new ProgressRelay(progress, cancellation))
            {
                var natives = meshes.Select(mesh => NativeInput.Mesh(mesh, pins)).ToArray();
                long first = (long)pins.Pin(natives);
                var pointers = new IntPtr[natives.Length];
                for (int i = 0; i < pointers.Length; i++) { pointers[i] = new IntPtr(first + (long)i * sizeof(NativeMesh)); }
                var options = NativeInput.Options(settings);
                var error = NativeError.Empty();
                var results = new IntPtr[pointers.Length];
                int status = NativeMethods.SceneRun(
                    pointers, (uint)pointers.Length, objects, (uint)objects.Length,
                    ref options, ProgressRelay.Callback, relay.User, results, ref error);
                if (status == NativeStatus.Ok) { return Array.ConvertAll(results, result => new ResultHandle(result)); }
                relay.Rethrow();
                throw Failure.OfScene(status, error, meshes.Select(mesh => mesh.Name).ToArray(), cancellation);
            }
        }
    }
}
