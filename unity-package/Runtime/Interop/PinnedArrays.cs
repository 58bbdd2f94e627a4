using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary>Arrays that stay where they are while native code reads or fills them.</summary>
    internal sealed class PinnedArrays : IDisposable
    {
        private readonly List<GCHandle> handles = new List<GCHandle>();

        /// <summary>Where the array begins; null for none, and for an empty one.</summary>
        internal IntPtr Pin(Array array)
        {
            if (array == null || array.Length == 0) { return IntPtr.Zero; }
            var handle = GCHandle.Alloc(array, GCHandleType.Pinned);
            handles.Add(handle);
            return handle.AddrOfPinnedObject();
        }

        public void Dispose()
        {
            foreach (var handle in handles) { handle.Free(); }
            handles.Clear();
        }

        /// <summary>A managed copy of a native array of structs; null where there is none.</summary>
        internal static unsafe T[] Copy<T>(IntPtr source, int count) where T : struct
        {
            if (source == IntPtr.Zero) { return null; }
            var copy = new T[count];
            using (var pins = new PinnedArrays())
            {
                long bytes = (long)count * Marshal.SizeOf(typeof(T));
                if (bytes > 0) { Buffer.MemoryCopy((void*)source, (void*)pins.Pin(copy), bytes, bytes); }
            }
            return copy;
        }
    }
}
