using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_options</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeOptions
    {
        public uint StructSize;
        public float Width;
        public uint WidthUnit;
        public uint Verify;
        public uint SubmeshMode;
        public uint Submesh;
        public uint Threads;
        public float LeastBreadth;
        public uint WidthMode;
        public float MinAngle;
        public float MaxAngle;
        public uint Convexity;
        public float HardAngle;
        public fixed float Scale[9];
        public float Evenness;
        public uint Segments;
        public float Profile;
    }
}
