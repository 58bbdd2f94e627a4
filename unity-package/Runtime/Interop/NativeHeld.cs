using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_held</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeHeld
    {
        public fixed float From[3];
        public fixed float To[3];
        public float Radius;
    }
}
