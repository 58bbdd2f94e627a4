using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_options</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeOptions
    {
        public uint StructSize;
        public float Width;
        public uint WidthUnit;
        public uint Verify;
        public uint SubmeshMode;
        public uint Submesh;
        public uint Threads;
        public float LeastBreadth;
    }
}
