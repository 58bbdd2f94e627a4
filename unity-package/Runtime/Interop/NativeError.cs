using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_error</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeError
    {
        internal const int MessageSize = 256;

        /// <summary>What <see cref="Element"/> and <see cref="Mesh"/> are where they name none.</summary>
        internal const uint None = 0xFFFFFFFF;

        public uint StructSize;
        public int Status;
        public uint Element;
        public fixed byte Message[MessageSize];
        public uint Mesh;

        internal static NativeError Empty()
        {
            return new NativeError { StructSize = (uint)sizeof(NativeError) };
        }

        internal string Text()
        {
            fixed (byte* first = Message)
            {
                int length = 0;
                while (length < MessageSize && first[length] != 0) { length++; }
                return Encoding.UTF8.GetString(first, length);
            }
        }
    }
}
