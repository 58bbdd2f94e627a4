using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// What became of the edges of chamfered meshes. It is kept beside the modifier, where undo does not lose it,
    /// and worked out anew after scripts were loaded again.
    /// </summary>
    internal static class VerdictCache
    {
        private static readonly Dictionary<Mesh, MeshVerdicts> known = new Dictionary<Mesh, MeshVerdicts>();

        internal static void Remember(Mesh chamfered, MeshVerdicts verdicts)
        {
            foreach (var gone in known.Keys.Where(mesh => mesh == null).ToList()) { known.Remove(gone); }
            known[chamfered] = verdicts;
        }

        /// <summary>Null where the mesh is gone or cannot be chamfered any more.</summary>
        internal static MeshVerdicts Of(ChamferModifier modifier, ChamferedMesh entry)
        {
            if (entry.original == null || entry.chamfered == null) { return null; }
            MeshVerdicts verdicts;
            // Undo may have given the mesh back what it held before.
            bool isKnown = known.TryGetValue(entry.chamfered, out verdicts)
                && (verdicts == null || verdicts.Settings.Equals(entry.settings));
            if (!isKnown) { ChamferAgain(modifier, entry.settings); }
            return known.TryGetValue(entry.chamfered, out verdicts) ? verdicts : null;
        }

        /// <summary>All meshes of a modifier, as they stood when they were chamfered.</summary>
        private static void ChamferAgain(ChamferModifier modifier, ChamferSettings settings)
        {
            var entries = modifier.meshes.FindAll(entry => entry.original != null && entry.chamfered != null);
            var objects = entries.ConvertAll(entry => new PlacedMesh(entry.original, entry.placed));
            foreach (var entry in entries) { known[entry.chamfered] = null; }
            foreach (var result in SceneRun.Run(objects, settings, null, CancellationToken.None, (why, mesh) => { }))
            {
                var verdicts = new MeshVerdicts(result.Source, result.Output.Report, settings);
                foreach (var entry in entries.FindAll(entry => entry.original == result.Mesh))
                {
                    known[entry.chamfered] = verdicts;
                }
            }
        }
    }
}
