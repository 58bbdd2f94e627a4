using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_vertex_source</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeVertexSource
    {
        public NativeBlend Surface;
        public NativeBlend Chart;
        public NativeBlend Owner;
        public uint OwnerChannels;

        /// <summary>Where the tangent comes from: it goes with the first UV channel.</summary>
        internal NativeBlend TangentChart
        {
            get { return (OwnerChannels & 1) != 0 ? Owner : Chart; }
        }

        internal static NativeVertexSource Of(int vertex)
        {
            var one = NativeBlend.Of(vertex);
            return new NativeVertexSource { Surface = one, Chart = one, Owner = one };
        }

        /// <summary>Whether the output vertex is this source vertex, unchanged.</summary>
        internal bool Is(int vertex)
        {
            int surface, chart;
            return OwnerChannels == 0
                && Surface.IsOne(out surface) && Chart.IsOne(out chart) && surface == vertex && chart == vertex;
        }
    }
}
