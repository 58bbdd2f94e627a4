using System;
using System.Collections.Generic;
using System.Threading;
using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What became of one mesh of a scene.</summary>
    internal struct SceneResult
    {
        public Mesh Mesh;
        public MeshArrays Source;
        public ArrayResult Output;
    }

    /// <summary>
    /// Chamfers what can be chamfered of a scene: a mesh at fault is left out, as if it stood nowhere.
    /// </summary>
    internal static class SceneRun
    {
        /// <summary>Reads and chamfers a scene, on the main thread.</summary>
        internal static List<SceneResult> Run(
            IEnumerable<PlacedMesh> objects,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation,
            Action<string, Mesh> failed)
        {
            return Run(Read(objects, MeshReader.Read, failed), settings, progress, cancellation, failed);
        }

        /// <summary>Chamfers a scene that was read, on any thread.</summary>
        /// <param name="scene">Loses what could not be chamfered.</param>
        /// <param name="settings">How.</param>
        /// <param name="progress">Told the share done.</param>
        /// <param name="cancellation">Asked whenever progress is told.</param>
        /// <param name="failed">Told what could not be chamfered and why.</param>
        internal static List<SceneResult> Run(
            SceneArrays scene,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation,
            Action<string, Mesh> failed)
        {
            while (scene.Meshes.Count > 0)
            {
                try { return Results(scene, settings, progress, cancellation); }
                catch (ChamferException exception)
                {
                    int mesh = exception.MeshNumber;
                    failed(exception.Message, mesh >= 0 ? scene.Meshes[mesh] : null);
                    if (mesh < 0) { break; }
                    scene.Remove(mesh);
                }
            }
            return new List<SceneResult>();
        }

        /// <summary>Reads what can be read, on the main thread.</summary>
        internal static SceneArrays Read(
            IEnumerable<PlacedMesh> objects,
            Func<Mesh, MeshArrays> read,
            Action<string, Mesh> failed)
        {
            var scene = new SceneArrays(new PlacedMesh[0], read);
            var unread = new HashSet<Mesh>();
            foreach (var item in objects)
            {
                if (unread.Contains(item.Mesh)) { continue; }
                try { scene.Add(item); }
                catch (ChamferException exception)
                {
                    unread.Add(item.Mesh);
                    failed(exception.Message, item.Mesh);
                }
            }
            return scene;
        }

        private static List<SceneResult> Results(
            SceneArrays scene,
            ChamferSettings settings,
            IProgress<float> progress,
            CancellationToken cancellation)
        {
            var outputs = SceneChamfer.Run(scene.Arrays, scene.Placed, settings, progress, cancellation);
            var results = new List<SceneResult>();
            for (int i = 0; i < outputs.Length; i++)
            {
                results.Add(new SceneResult { Mesh = scene.Meshes[i], Source = scene.Arrays[i], Output = outputs[i] });
            }
            return results;
        }
    }
}
