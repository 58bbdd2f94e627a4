using System;
using System.Threading;
using Chamfer.Interop;

namespace Chamfer.Streams
{
    /// <summary>Turns native statuses into exceptions.</summary>
    internal static class Failure
    {
        internal static Exception Of(int status, NativeError error, string mesh, CancellationToken cancellation)
        {
            string message = error.Text();
            if (status == NativeStatus.Cancelled) { return new OperationCanceledException(cancellation); }
            if (status >= NativeStatus.Internal) { return new LibraryFaultException(message); }
            if (status >= NativeStatus.FirstOfResource) { return new ResultTooLargeException(message); }
            if (status >= NativeStatus.FirstOfMesh) { return new InvalidMeshException(mesh, message, (int)error.Element); }
            return new InvalidSettingsException(message);
        }

        /// <summary>For calls that fail only if the package and the library disagree.</summary>
        internal static void Require(int status)
        {
            if (status != NativeStatus.Ok) { throw new LibraryFaultException("status " + status); }
        }
    }
}
