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
            if (status == NativeStatus.Cancelled) { return new OperationCanceledException(cancellation); }
            return Of(status, error.Text(), (int)error.Element, mesh);
        }

        /// <summary>As <see cref="Of(int, NativeError, string, CancellationToken)"/>, of several meshes.</summary>
        /// <param name="names"><c>#meshes</c></param>
        internal static Exception OfScene(int status, NativeError error, string[] names, CancellationToken cancellation)
        {
            if (status == NativeStatus.Cancelled) { return new OperationCanceledException(cancellation); }
            if (error.Mesh == NativeError.None) { return Of(status, error.Text(), (int)error.Element, "scene"); }
            // Users know the mesh by its name only.
            string number = "mesh " + error.Mesh + ": ";
            string text = error.Text();
            if (text.StartsWith(number, StringComparison.Ordinal)) { text = text.Substring(number.Length); }
            var exception = Of(status, text, (int)error.Element, names[error.Mesh]);
            exception.MeshNumber = (int)error.Mesh;
            return exception;
        }

        /// <summary>For calls that fail only if the package and the library disagree.</summary>
        internal static void Require(int status)
        {
            if (status != NativeStatus.Ok) { throw new LibraryFaultException("status " + status); }
        }

        private static ChamferException Of(int status, string message, int element, string mesh)
        {
            if (status >= NativeStatus.Internal) { return new LibraryFaultException(message); }
            if (status >= NativeStatus.FirstOfResource) { return new ResultTooLargeException(message); }
            if (status >= NativeStatus.FirstOfMesh) { return new InvalidMeshException(mesh, message, element); }
            return new InvalidSettingsException(message);
        }
    }
}
