using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_totals</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeTotals
    {
        internal const int ReasonSlots = 16;

        public uint StructSize;
        public uint HardEdges;
        public uint Chamfered;
        public uint Narrowed;
        public uint Skipped;
        public float Width;
        public float MeanWidth;
        public fixed uint SkippedByReason[ReasonSlots];

        internal static NativeTotals Empty()
        {
            return new NativeTotals { StructSize = (uint)sizeof(NativeTotals) };
        }
    }
}
