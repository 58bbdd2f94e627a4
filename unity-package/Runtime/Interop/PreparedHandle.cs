using System;
using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary>A <c>chamfer_prepared</c>, which is freed once nobody runs it any more.</summary>
    internal sealed class PreparedHandle : SafeHandle
    {
        public PreparedHandle() : base(IntPtr.Zero, true) { }

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected override bool ReleaseHandle()
        {
            NativeMethods.PreparedDestroy(handle);
            return true;
        }
    }
}
