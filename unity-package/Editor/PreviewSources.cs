using System.Collections.Generic;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The sources of the last previews, as they were read: a drag asks for many widths of the same mesh.</summary>
    internal static class PreviewSources
    {
        /// <summary>They are as large as the meshes, so only those of some objects are kept.</summary>
        private const int Most = 8;

        private sealed class Source
        {
            internal Mesh Mesh;
            internal int DirtyCount;
            internal MeshArrays Arrays;
        }

        private static readonly List<Source> sources = new List<Source>();

        /// <summary>Whoever selects something else has ended the drag.</summary>
        [InitializeOnLoadMethod]
        internal static void Listen()
        {
            Selection.selectionChanged -= sources.Clear;
            Selection.selectionChanged += sources.Clear;
        }

        /// <summary>What a mesh holds; it is read anew only where it has changed. On the main thread.</summary>
        internal static MeshArrays Read(Mesh mesh)
        {
            int dirtyCount = EditorUtility.GetDirtyCount(mesh);
            var found = sources.Find(source => ReferenceEquals(source.Mesh, mesh) && source.DirtyCount == dirtyCount);
            if (found == null) { found = new Source { Mesh = mesh, DirtyCount = dirtyCount, Arrays = MeshReader.Read(mesh) }; }
            sources.RemoveAll(source => source.Mesh == null || ReferenceEquals(source.Mesh, mesh));
            sources.Insert(0, found);
            if (sources.Count > Most) { sources.RemoveAt(Most); }
            return found.Arrays;
        }
    }
}
