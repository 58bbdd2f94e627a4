using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Chamfer;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Tells meshes by what they hold, the same on every machine: whether a source has changed, and which objects can
    /// share a result.
    /// </summary>
    internal static class MeshKeys
    {
        /// <summary>The key of what cannot be read.</summary>
        internal const string Unknown = "";

        private struct Known
        {
            public int DirtyCount;
            public string Key;
        }

        private static readonly Dictionary<Mesh, Known> known = new Dictionary<Mesh, Known>();

        /// <summary>Of everything that a mesh holds; it is only read again where it has changed.</summary>
        internal static string Of(Mesh mesh)
        {
            Known found;
            int dirtyCount = EditorUtility.GetDirtyCount(mesh);
            if (known.TryGetValue(mesh, out found) && found.DirtyCount == dirtyCount) { return found.Key; }
            foreach (var gone in known.Keys.Where(other => other == null).ToList()) { known.Remove(gone); }
            found = new Known { DirtyCount = dirtyCount, Key = Read(mesh) };
            known[mesh] = found;
            return found.Key;
        }

        /// <summary>All that a result depends on; unknown where one of the parts is.</summary>
        internal static string Join(params string[] parts)
        {
            if (parts.Contains(Unknown)) { return Unknown; }
            var hash = ContentHash.Begin();
            foreach (string part in parts)
            {
                foreach (char letter in part) { hash.Add((ulong)letter); }
                hash.Add(ulong.MaxValue);
            }
            return Text(hash.Value);
        }

        private static string Read(Mesh mesh)
        {
            try { return Text(ContentHash.Of(MeshReader.Read(mesh))); }
            catch (ChamferException) { return Unknown; }
        }

        private static string Text(ulong hash)
        {
            return hash.ToString("x16", CultureInfo.InvariantCulture);
        }
    }
}
