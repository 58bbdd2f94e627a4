namespace Chamfer.Interop
{
    /// <summary>The statuses that the package tells apart; the rest by their band.</summary>
    internal static class NativeStatus
    {
        internal const int Ok = 0;
        internal const int Cancelled = 1;

        /// <summary>From here the call is wrong.</summary>
        internal const int FirstOfCall = 100;

        /// <summary>From here the mesh is wrong.</summary>
        internal const int FirstOfMesh = 200;

        /// <summary>From here a resource ran out.</summary>
        internal const int FirstOfResource = 300;

        /// <summary>A fault of the library.</summary>
        internal const int Internal = 900;
    }
}
