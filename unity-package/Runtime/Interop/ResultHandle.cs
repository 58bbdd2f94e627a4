using System;
using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary>A <c>chamfer_result</c>, which is freed exactly once.</summary>
    internal sealed class ResultHandle : SafeHandle
    {
        public ResultHandle() : base(IntPtr.Zero, true) { }

        /// <summary>For results that come in an array.</summary>
        internal ResultHandle(IntPtr result) : base(IntPtr.Zero, true)
        {
            SetHandle(result);
        }

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected override bool ReleaseHandle()
        {
            NativeMethods.ResultDestroy(handle);
            return true;
        }
    }
}
