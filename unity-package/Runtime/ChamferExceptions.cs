using System;

namespace Chamfer
{
    /// <summary>A mesh could not be chamfered; the message says what to do.</summary>
    public abstract class ChamferException : Exception
    {
        private protected ChamferException(string message, Exception inner = null) : base(message, inner) { }

        /// <summary>Which of the meshes of a scene is at fault; -1 if none.</summary>
        internal int MeshNumber { get; set; } = -1;
    }

    /// <summary>The native library is not there for this platform.</summary>
    public sealed class LibraryMissingException : ChamferException
    {
        internal LibraryMissingException(string platform, Exception inner)
            : base("There is no native chamfer library for " + platform + ": build it from the sources for that "
                + "platform and put it into the package's folder Runtime/Plugins", inner) { }

        private LibraryMissingException(string message) : base(message) { }

        /// <summary>For platforms on which the package does not even look for the library.</summary>
        internal static LibraryMissingException OnThisPlatform()
        {
            return new LibraryMissingException("The package has no native chamfer library for this platform: chamfer "
                + "meshes in the editor or when they are imported; or build the library from its sources, add it to the "
                + "project as a plugin, and define the scripting symbol CHAMFER_LIBRARY for the platform");
        }
    }

    /// <summary>The native library and the package are of different versions.</summary>
    public sealed class LibraryVersionException : ChamferException
    {
        internal LibraryVersionException(string found, Exception inner = null)
            : base("The native chamfer library is of another version than the package (" + found
                + "): install the package anew and restart Unity, which keeps an old library loaded", inner) { }
    }

    /// <summary>Unity does not allow scripts to read the mesh.</summary>
    public sealed class MeshNotReadableException : ChamferException
    {
        internal MeshNotReadableException(string mesh, string why)
            : base("The mesh '" + mesh + "' cannot be read" + why
                + ": switch on Read/Write in the import settings of its model") { }
    }

    /// <summary>A setting has a value that makes no sense.</summary>
    public sealed class InvalidSettingsException : ChamferException
    {
        internal InvalidSettingsException(string message) : base(message) { }
    }

    /// <summary>The mesh breaks a rule that chamfering relies on.</summary>
    public sealed class InvalidMeshException : ChamferException
    {
        internal InvalidMeshException(string mesh, string message, int element)
            : base("The mesh '" + mesh + "': " + message)
        {
            Element = element;
        }

        /// <summary>The vertex, index, submesh or UV channel that the message is about; -1 if none.</summary>
        public int Element { get; }
    }

    /// <summary>The result would be too large for memory or for 32-bit indices.</summary>
    public sealed class ResultTooLargeException : ChamferException
    {
        internal ResultTooLargeException(string message) : base(message) { }
    }

    /// <summary>A fault of the native library.</summary>
    public sealed class LibraryFaultException : ChamferException
    {
        internal LibraryFaultException(string message) : base("Please report this: " + message) { }
    }
}
