using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary><c>chamfer_blend</c></summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeBlend
    {
        internal const int Count = 3;

        public fixed uint Vertices[Count];
        public fixed float Weights[Count];

        /// <summary>The blend that is one source vertex, unchanged.</summary>
        internal static NativeBlend Of(int vertex)
        {
            var blend = new NativeBlend();
            blend.Vertices[0] = (uint)vertex;
            blend.Weights[0] = 1;
            return blend;
        }

        /// <summary>Whether this is one source vertex, unchanged: then <paramref name="vertex"/> is it.</summary>
        internal bool IsOne(out int vertex)
        {
            fixed (uint* vertices = Vertices)
            fixed (float* weights = Weights)
            {
                vertex = (int)vertices[0];
                return weights[0] == 1 && weights[1] == 0 && weights[2] == 0;
            }
        }
    }
}
