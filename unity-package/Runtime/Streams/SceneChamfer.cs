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

        /// <summary>How it is scaled in the world.</summary>
        public Vector3 WorldScale;

        /// <summary>The names of its materials, one for each submesh; null for none.</summary>
        public string[] Materials;
    }

    /// <summary>Chamfers the arrays of meshes that stand together, on any thread.</summary>
    internal sealed class SceneChamfer
    {
        private readonly IReadOnlyList<MeshArrays> meshes;
        private readonly NativeObject[] objects;
        private readonly ChamferSettings settings;
        private readonly CancellationToken cancellation;

        /// <summary><c>#meshes</c>: where each stands first.</summary>
        private readonly PlacedArrays[] firsts;

        private SceneChamfer(
            IReadOnlyList<MeshArrays> meshes,
            IEnumerable<PlacedArrays> placed,
            ChamferSettings settings,
            CancellationToken cancellation)
        {
            this.meshes = meshes;
            this.settings = settings;
            this.cancellation = cancellation;
            firsts = new PlacedArrays[meshes.Count];
            foreach (var one in placed.Reverse()) { firsts[one.Mesh] = one; }
            objects = placed.Select(one => NativeObject.Of(one.Mesh, one.Transform)).ToArray();
        }

        /// <returns><c>#meshes</c></returns>
        /// <param name="keepsVerdicts">Whether somebody asks for each edge by itself.</param>
        /// <exception cref="ChamferException">With the number of the mesh at fault, if it is one.</exception>
        internal static ArrayResult[] Run(
            IReadOnlyList<MeshArrays> meshes,
            IEnumerable<PlacedArrays> placed,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation,
            bool keepsVerdicts = true)
        {
            LibraryCheck.Require();
            var scene = new SceneChamfer(meshes, placed, settings, cancellation);
            for (int mesh = 0; mesh < meshes.Count; mesh++) { scene.Require(mesh); }
            cancellation.ThrowIfCancellationRequested();
            var watch = Stopwatch.StartNew();
            var results = scene.Run(progress);
            watch.Stop();
            try { return results.Select((result, mesh) => ArrayChamfer.Finish(meshes[mesh], result, watch.Elapsed, keepsVerdicts)).ToArray(); }
            finally { foreach (var result in results) { result.Dispose(); } }
        }

        private void Require(int mesh)
        {
            try
            {
                SettingsCheck.Require(meshes[mesh], settings);
                SettingsCheck.RequireScale(meshes[mesh], ScaleOf(mesh));
            }
            catch (ChamferException exception)
            {
                exception.MeshNumber = mesh;
                throw;
            }
        }

        /// <summary>In which a mesh is measured; zeros for the mesh as it is. A mirror changes no width.</summary>
        private Vector3 ScaleOf(int mesh)
        {
            var scale = firsts[mesh].WorldScale;
            if (!settings.edges.worldWidth) { return new Vector3(); }
            return new Vector3(Math.Abs(scale.x), Math.Abs(scale.y), Math.Abs(scale.z));
        }

        /// <summary>The library measures all that it is given in one scale: so it is asked once for each.</summary>
        private ResultHandle[] Run(IProgress<float> progress)
        {
            var results = new ResultHandle[meshes.Count];
            var scales = Enumerable.Range(0, meshes.Count).GroupBy(ScaleOf).ToList();
            try
            {
                for (int i = 0; i < scales.Count; i++)
                {
                    RunScale(scales[i].Key, new HashSet<int>(scales[i]), PartProgress.Of(progress, i, scales.Count), results);
                }
                return results;
            }
            catch
            {
                foreach (var result in results.Where(one => one != null)) { result.Dispose(); }
                throw;
            }
        }

        /// <summary>Meshes of other scales only stand around.</summary>
        private void RunScale(Vector3 scale, HashSet<int> wanted, IProgress<float> progress, ResultHandle[] results)
        {
            var made = Call(scale, wanted, progress);
            for (int mesh = 0; mesh < made.Length; mesh++)
            {
                if (wanted.Contains(mesh)) { results[mesh] = made[mesh]; }
                else { made[mesh].Dispose(); }
            }
        }

        private MeshFactors FactorsOf(int mesh, HashSet<int> wanted)
        {
            if (!wanted.Contains(mesh)) { return MeshFactors.Zero(meshes[mesh]); }
            return MeshFactors.Of(meshes[mesh], settings.edges, firsts[mesh].Materials);
        }

        private unsafe ResultHandle[] Call(Vector3 scale, HashSet<int> wanted, IProgress<float> progress)
        {
            using (var pins = new PinnedArrays())
            using (var relay = new ProgressRelay(progress, cancellation))
            {
                var natives = meshes.Select((mesh, i) => NativeInput.Mesh(mesh, pins, FactorsOf(i, wanted))).ToArray();
                long first = (long)pins.Pin(natives);
                var pointers = new IntPtr[natives.Length];
                for (int i = 0; i < pointers.Length; i++) { pointers[i] = new IntPtr(first + (long)i * sizeof(NativeMesh)); }
                var options = NativeInput.Options(settings, scale);
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
