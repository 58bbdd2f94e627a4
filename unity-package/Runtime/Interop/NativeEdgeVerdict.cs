using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_edge_verdict</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeEdgeVerdict
    {
        public fixed uint Vertices[2];
        public uint Outcome;
        public uint Reason;
        public fixed float Widths[2];
        public uint Segments;
    }
}
