using System;
using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_mesh</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeMesh
    {
        public uint StructSize;
        public uint VertexCount;
        public IntPtr Positions;
        public IntPtr Normals;
        public IntPtr Tangents;
        public IntPtr Colors;
        public UvChannels Uvs;
        public uint SubmeshCount;
        public uint IndexCount;
        public IntPtr SubmeshIndexCounts;
        public IntPtr Indices;
        public uint HeldCount;
        public IntPtr Held;
        public IntPtr SubmeshFactors;
        public IntPtr VertexFactors;
        public uint EdgeFactorCount;
        public IntPtr EdgeFactors;

        internal static NativeMesh Empty()
        {
            return new NativeMesh { StructSize = (uint)sizeof(NativeMesh) };
        }

        /// <summary>The array <c>uvs</c>, which C# cannot declare as one.</summary>
        [StructLayout(LayoutKind.Sequential)]
        internal struct UvChannels
        {
            internal const int Count = 8;

#pragma warning disable 169 // All but the first are reached by the indexer only.
            private NativeUv uv0, uv1, uv2, uv3, uv4, uv5, uv6, uv7;
#pragma warning restore 169

            internal NativeUv this[int channel]
            {
                get
                {
                    Require(channel);
                    fixed (NativeUv* first = &uv0) { return first[channel]; }
                }
                set
                {
                    Require(channel);
                    fixed (NativeUv* first = &uv0) { first[channel] = value; }
                }
            }

            private static void Require(int channel)
            {
                if (channel < 0 || channel >= Count) { throw new ArgumentOutOfRangeException(nameof(channel)); }
            }
        }
    }
}
