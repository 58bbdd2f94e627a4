using System.Runtime.InteropServices;
using UnityEngine;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_object</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeObject
    {
        internal const int Count = 16;

        public uint Mesh;
        public fixed float Transform[Count];

        internal static NativeObject Of(int mesh, Matrix4x4 transform)
        {
            var native = new NativeObject { Mesh = (uint)mesh };
            // Both count column by column.
            for (int place = 0; place < Count; place++) { native.Transform[place] = transform[place]; }
            return native;
        }
    }
}
