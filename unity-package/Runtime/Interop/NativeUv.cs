using System;
using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_uv</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeUv
    {
        public uint Components;
        public IntPtr Values;
    }
}
