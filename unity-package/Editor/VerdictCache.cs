using System.Collections.Generic;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>
    /// What became of the edges of the meshes that were chamfered last, by what they were made of: undo brings back
    /// keys, and so their edges. After scripts were loaded again it is empty, and nothing is chamfered to fill it.
    /// </summary>
    internal static class VerdictCache
    {
        /// <summary>They have a line for each hard edge, so only some are kept.</summary>
        private const int Most = 16;

        private static readonly Dictionary<string, MeshVerdicts> known = new Dictionary<string, MeshVerdicts>();
        private static readonly List<string> order = new List<string>();

        internal static void Remember(string key, MeshVerdicts verdicts)
        {
            if (key == MeshKeys.Unknown) { return; }
            order.Remove(key);
            order.Add(key);
            known[key] = verdicts;
            if (order.Count <= Most) { return; }
            known.Remove(order[0]);
            order.RemoveAt(0);
        }

        /// <summary>Null where they are not known any more: chamfer again to see them.</summary>
        internal static MeshVerdicts Of(ChamferedMesh entry)
        {
            MeshVerdicts verdicts;
            return known.TryGetValue(entry.key ?? MeshKeys.Unknown, out verdicts) ? verdicts : null;
        }
    }
}
