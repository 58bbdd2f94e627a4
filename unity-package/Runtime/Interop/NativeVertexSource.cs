using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_vertex_source</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeVertexSource
    {
        public NativeBlend Surface;
        public NativeBlend Chart;

        internal static NativeVertexSource Of(int vertex)
        {
            return new NativeVertexSource { Surface = NativeBlend.Of(vertex), Chart = NativeBlend.Of(vertex) };
        }

        /// <summary>Whether the output vertex is this source vertex, unchanged.</summary>
        internal bool Is(int vertex)
        {
            int surface, chart;
            return Surface.IsOne(out surface) && Chart.IsOne(out chart) && surface == vertex && chart == vertex;
        }
    }
}
