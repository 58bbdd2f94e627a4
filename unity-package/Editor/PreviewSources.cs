using System.Collections.Generic;
using System.Linq;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The sources of the last previews, read and prepared: a drag asks for many widths of the same mesh.</summary>
    internal static class PreviewSources
    {
        /// <summary>They are as large as the meshes, so only those of some objects are kept.</summary>
        private const int Most = 8;

        private sealed class Source
        {
            internal Mesh Mesh;
            internal int DirtyCount;
            internal MeshArrays Arrays;
            internal PreparedMesh Prepared;
        }

        private static readonly List<Source> sources = new List<Source>();

        /// <summary>What a mesh holds; it is read anew only where it has changed. On the main thread.</summary>
        internal static MeshArrays Read(Mesh mesh)
        {
            return Find(mesh).Arrays;
        }

        /// <summary>A mesh that stands alone, prepared. On the main thread.</summary>
        internal static PreparedMesh Prepare(Mesh mesh)
        {
            var source = Find(mesh);
            if (source.Prepared == null) { source.Prepared = new PreparedMesh(source.Arrays); }
            return source.Prepared;
        }

        /// <summary>Whoever selects something else has ended the drag.</summary>
        [InitializeOnLoadMethod]
        internal static void Listen()
        {
            Selection.selectionChanged -= Clear;
            Selection.selectionChanged += Clear;
        }

        private static void Clear()
        {
            while (sources.Count > 0) { Drop(sources[0]); }
        }

        private static Source Find(Mesh mesh)
        {
            int dirtyCount = EditorUtility.GetDirtyCount(mesh);
            var found = sources.Find(source => ReferenceEquals(source.Mesh, mesh) && source.DirtyCount == dirtyCount);
            if (found == null) { found = new Source { Mesh = mesh, DirtyCount = dirtyCount, Arrays = MeshReader.Read(mesh) }; }
            foreach (var old in sources.Where(source => source != found && IsOld(source, mesh)).ToList()) { Drop(old); }
            sources.Remove(found);
            sources.Insert(0, found);
            if (sources.Count > Most) { Drop(sources[Most]); }
            return found;
        }

        private static bool IsOld(Source source, Mesh mesh)
        {
            return source.Mesh == null || ReferenceEquals(source.Mesh, mesh);
        }

        /// <summary>Whoever still runs it keeps it until then.</summary>
        private static void Drop(Source source)
        {
            sources.Remove(source);
            if (source.Prepared != null) { source.Prepared.Dispose(); }
        }
    }
}
