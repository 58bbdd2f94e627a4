using System;
using System.Runtime.InteropServices;
using Chamfer.Interop;

namespace Chamfer.Streams
{
    /// <summary>Whether the native library is there and fits.</summary>
    internal static class LibraryCheck
    {
        private static bool passed;

        /// <summary>Throws <see cref="LibraryMissingException"/> or <see cref="LibraryVersionException"/>.</summary>
        internal static void Require()
        {
            if (passed) { return; }
            Check(NativeMethods.LibraryAbiVersion);
            passed = true;
        }

        /// <summary>The library's version; "none" where there is no library that fits.</summary>
        internal static string Version()
        {
            try { Require(); }
            catch (ChamferException) { return "none"; }
            return Marshal.PtrToStringAnsi(NativeMethods.VersionString());
        }

        internal static void Check(Func<uint> abiVersion)
        {
            try { Compare(abiVersion()); }
            catch (DllNotFoundException exception) { throw Missing(exception); }
            catch (BadImageFormatException exception) { throw Missing(exception); }
            catch (EntryPointNotFoundException exception) { throw new LibraryVersionException(exception.Message, exception); }
        }

        private static void Compare(uint found)
        {
            if (found == NativeMethods.AbiVersion) { return; }
            throw new LibraryVersionException("interface " + found + " instead of " + NativeMethods.AbiVersion);
        }

        private static Exception Missing(Exception inner)
        {
            string platform = Environment.OSVersion.Platform + ", " + IntPtr.Size * 8 + " bit";
            return new LibraryMissingException(platform, inner);
        }
    }
}
