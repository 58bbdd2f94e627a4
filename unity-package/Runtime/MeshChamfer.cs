using System;
using System.Collections.Generic;
using System.Threading;
using System.Threading.Tasks;
using Chamfer.Streams;
using UnityEngine;

namespace Chamfer
{
    /// <summary>Softens all hard edges of meshes.</summary>
    public static class MeshChamfer
    {
        /// <summary>
        /// Chamfers a mesh into a new one; the source is not changed. Call it on the main thread. It knows of no materials
        /// and of no scale in the world: <see cref="RunScene"/> does.
        /// </summary>
        /// <param name="source">Readable; in the editor, any mesh.</param>
        /// <param name="settings">How; begin with <see cref="ChamferSettings.Default"/>.</param>
        /// <param name="progress">Told the share done, 0 to 1, on the calling thread.</param>
        /// <param name="cancellation">Asked whenever progress is told.</param>
        /// <exception cref="ChamferException">The message says what to do.</exception>
        /// <exception cref="OperationCanceledException">It was cancelled.</exception>
        public static ChamferResult Run(
            Mesh source,
            ChamferSettings settings,
            IProgress<float> progress = null,
            CancellationToken cancellation = default(CancellationToken))
        {
            return Finish(ArrayChamfer.Run(MeshReader.Read(source), settings, progress, cancellation), source);
        }

        /// <summary>
        /// As <see cref="Run"/>, but the work between reading and writing the mesh runs on another thread, and
        /// so does <paramref name="progress"/>. Call it on the main thread.
        /// </summary>
        public static async Task<ChamferResult> RunAsync(
            Mesh source,
            ChamferSettings settings,
            IProgress<float> progress = null,
            CancellationToken cancellation = default(CancellationToken))
        {
            var arrays = MeshReader.Read(source);
            // Unity's synchronization context brings the rest back to the main thread.
            return Finish(await Task.Run(() => ArrayChamfer.Run(arrays, settings, progress, cancellation)), source);
        }

        /// <summary>
        /// Chamfers meshes that stand together, each once: an edge stays as it is where the open border of another
        /// object rests on it, so that no gap opens. With <see cref="VerifyMode.Seen"/> they are looked at together.
        /// Call it on the main thread.
        /// </summary>
        /// <param name="objects">Where the meshes stand; one mesh may stand in several places.</param>
        /// <param name="settings">How; begin with <see cref="ChamferSettings.Default"/>.</param>
        /// <param name="progress">Told the share done, 0 to 1, on the calling thread.</param>
        /// <param name="cancellation">Asked whenever progress is told.</param>
        /// <returns>What became of each mesh.</returns>
        /// <exception cref="ChamferException">A mesh cannot be chamfered; then none is.</exception>
        /// <exception cref="OperationCanceledException">It was cancelled.</exception>
        public static Dictionary<Mesh, ChamferResult> RunScene(
            IEnumerable<PlacedMesh> objects,
            ChamferSettings settings,
            IProgress<float> progress = null,
            CancellationToken cancellation = default(CancellationToken))
        {
            var scene = new SceneArrays(objects);
            return Finish(scene, SceneChamfer.Run(scene.Arrays, scene.Placed, settings, progress, cancellation));
        }

        /// <summary>As <see cref="RunScene"/>, on another thread as <see cref="RunAsync"/>.</summary>
        public static async Task<Dictionary<Mesh, ChamferResult>> RunSceneAsync(
            IEnumerable<PlacedMesh> objects,
            ChamferSettings settings,
            IProgress<float> progress = null,
            CancellationToken cancellation = default(CancellationToken))
        {
            var scene = new SceneArrays(objects);
            return Finish(scene, await Task.Run(
                () => SceneChamfer.Run(scene.Arrays, scene.Placed, settings, progress, cancellation)));
        }

#if UNITY_6000_0_OR_NEWER
        /// <summary>As <see cref="RunAsync"/>, for code that awaits Unity's own kind of task.</summary>
        public static Awaitable<ChamferResult> RunAwaitable(
            Mesh source,
            ChamferSettings settings,
            IProgress<float> progress = null,
            CancellationToken cancellation = default(CancellationToken))
        {
            var completion = new AwaitableCompletionSource<ChamferResult>();
            Complete(completion, RunAsync(source, settings, progress, cancellation));
            return completion.Awaitable;
        }

        private static async void Complete(AwaitableCompletionSource<ChamferResult> completion, Task<ChamferResult> task)
        {
            try { completion.SetResult(await task); }
            catch (OperationCanceledException) { completion.SetCanceled(); }
            catch (Exception exception) { completion.SetException(exception); }
        }

#endif
        private static Dictionary<Mesh, ChamferResult> Finish(SceneArrays scene, ArrayResult[] results)
        {
            var finished = new Dictionary<Mesh, ChamferResult>();
            for (int i = 0; i < results.Length; i++) { finished.Add(scene.Meshes[i], Finish(results[i], scene.Meshes[i])); }
            return finished;
        }

        private static ChamferResult Finish(ArrayResult result, Mesh source)
        {
            return new ChamferResult(MeshWriter.Write(result.Mesh, source), result.Report);
        }
    }
}
