using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Chamfer;
using Chamfer.Streams;
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
        internal static MeshVerdicts Of(ChamferedMesh entry)
        {
            if (entry.original == null || entry.chamfered == null) { return null; }
            MeshVerdicts verdicts;
            // Undo may have given the mesh back what it held before.
            bool isKnown = known.TryGetValue(entry.chamfered, out verdicts)
                && (verdicts == null || verdicts.Settings.Equals(entry.settings));
            return isKnown ? verdicts : known[entry.chamfered] = Again(entry);
        }

        private static MeshVerdicts Again(ChamferedMesh entry)
        {
            try
            {
                var source = MeshReader.Read(entry.original);
                var output = ArrayChamfer.Run(source, entry.settings, null, CancellationToken.None);
                return new MeshVerdicts(source.Positions, output.Report, entry.settings);
            }
            catch (ChamferException) { return null; }
        }
    }
}
