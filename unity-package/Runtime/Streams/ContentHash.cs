using System;
using Chamfer.Interop;

namespace Chamfer.Streams
{
    /// <summary>
    /// A number that tells whether a mesh is still what it was: the same on every machine for the same values.
    /// </summary>
    internal struct ContentHash
    {
        /// <summary>Fowler, Noll and Vo's prime and offset for 64 bits, here over words instead of bytes.</summary>
        private const ulong Prime = 1099511628211;
        private const ulong Offset = 14695981039346656037;

        private ulong hash;

        internal static ContentHash Begin()
        {
            return new ContentHash { hash = Offset };
        }

        /// <summary>Of everything that a mesh holds but its name.</summary>
        internal static ulong Of(MeshArrays mesh)
        {
            var content = Begin();
            content.Add(mesh.Positions);
            content.Add(mesh.Normals);
            content.Add(mesh.Tangents);
            content.Add(mesh.Colors);
            foreach (var uvs in mesh.Uvs) { content.Add(uvs); }
            foreach (var submesh in mesh.Submeshes)
            {
                content.Add((ulong)submesh.Topology);
                content.Add(submesh.Indices);
            }
            content.AddDeformation(mesh);
            return content.Value;
        }

        /// <summary>Mixed at the end, because the last word would change the upper bits only.</summary>
        internal ulong Value
        {
            get { return (hash ^ (hash >> 32)) * Prime; }
        }

        internal void Add(ulong word)
        {
            hash = (hash ^ word) * Prime;
            hash ^= hash >> 29;
        }

        internal unsafe void Add(float number)
        {
            Add((ulong)*(uint*)&number);
        }

        /// <summary>An array of numbers, or of structs of such; none counts as well.</summary>
        internal unsafe void Add(Array array)
        {
            Add(array == null ? ulong.MaxValue : (ulong)array.Length);
            if (array == null || array.Length == 0) { return; }
            using (var pins = new PinnedArrays())
            {
                int bytes = array.Length * System.Runtime.InteropServices.Marshal.SizeOf(array.GetType().GetElementType());
                byte* first = (byte*)pins.Pin(array);
                for (int i = 0; i < bytes / sizeof(ulong); i++) { Add(((ulong*)first)[i]); }
                for (int i = bytes / sizeof(ulong) * sizeof(ulong); i < bytes; i++) { Add((ulong)first[i]); }
            }
        }

        private void AddDeformation(MeshArrays mesh)
        {
            if (mesh.Skin != null)
            {
                Add(mesh.Skin.BonesPerVertex);
                Add(mesh.Skin.Weights);
                Add(mesh.Skin.Bindposes);
            }
            foreach (var frame in mesh.BlendShapes)
            {
                Add(frame.Weight);
                Add(frame.Positions);
                Add(frame.Normals);
                Add(frame.Tangents);
            }
        }
    }
}
