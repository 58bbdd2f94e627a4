using System;
using System.Runtime.InteropServices;

namespace Chamfer.Interop
{
    /// <summary>Called on the calling thread with the share done; any result but 0 cancels.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal delegate int NativeProgress(IntPtr user, float done);

    /// <summary>The functions of the native library that the package calls.</summary>
    internal static class NativeMethods
    {
        /// <summary>The version of the interface that these declarations describe.</summary>
        internal const uint AbiVersion = 1;

#if UNITY_EDITOR || UNITY_STANDALONE || CHAMFER_LIBRARY
#if (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS || UNITY_WEBGL || UNITY_SWITCH) && !UNITY_EDITOR
        private const string Library = "__Internal";
#else
        private const string Library = "chamfer";
#endif
        private const CallingConvention Cdecl = CallingConvention.Cdecl;

        [DllImport(Library, EntryPoint = "chamfer_abi_version", CallingConvention = Cdecl)]
        internal static extern uint LibraryAbiVersion();

        [DllImport(Library, EntryPoint = "chamfer_version_string", CallingConvention = Cdecl)]
        internal static extern IntPtr VersionString();

        [DllImport(Library, EntryPoint = "chamfer_run", CallingConvention = Cdecl)]
        internal static extern int Run(
            ref NativeMesh mesh,
            ref NativeOptions options,
            NativeProgress progress,
            IntPtr user,
            out ResultHandle result,
            ref NativeError error);

        /// <param name="meshes">Where each <see cref="NativeMesh"/> is.</param>
        /// <param name="results">As long as <paramref name="meshes"/>; filled in.</param>
        [DllImport(Library, EntryPoint = "chamfer_scene_run", CallingConvention = Cdecl)]
        internal static extern int SceneRun(
            [In] IntPtr[] meshes,
            uint meshCount,
            [In] NativeObject[] objects,
            uint objectCount,
            ref NativeOptions options,
            NativeProgress progress,
            IntPtr user,
            [Out] IntPtr[] results,
            ref NativeError error);

        [DllImport(Library, EntryPoint = "chamfer_result_mesh", CallingConvention = Cdecl)]
        internal static extern int ResultMesh(ResultHandle result, ref NativeMesh mesh);

        [DllImport(Library, EntryPoint = "chamfer_result_totals", CallingConvention = Cdecl)]
        internal static extern int ResultTotals(ResultHandle result, ref NativeTotals totals);

        [DllImport(Library, EntryPoint = "chamfer_result_verdicts", CallingConvention = Cdecl)]
        internal static extern int ResultVerdicts(ResultHandle result, out IntPtr verdicts, out uint count);

        [DllImport(Library, EntryPoint = "chamfer_result_vertex_sources", CallingConvention = Cdecl)]
        internal static extern int ResultVertexSources(ResultHandle result, out IntPtr sources, out uint count);

        [DllImport(Library, EntryPoint = "chamfer_result_destroy", CallingConvention = Cdecl)]
        internal static extern void ResultDestroy(IntPtr result);

        [DllImport(Library, EntryPoint = "chamfer_prepare", CallingConvention = Cdecl)]
        internal static extern int Prepare(ref NativeMesh mesh, out PreparedHandle prepared, ref NativeError error);

        [DllImport(Library, EntryPoint = "chamfer_prepared_run", CallingConvention = Cdecl)]
        internal static extern int PreparedRun(
            PreparedHandle prepared,
            ref NativeOptions options,
            NativeProgress progress,
            IntPtr user,
            out ResultHandle result,
            ref NativeError error);

        [DllImport(Library, EntryPoint = "chamfer_prepared_destroy", CallingConvention = Cdecl)]
        internal static extern void PreparedDestroy(IntPtr prepared);
#else
        // A player for a platform without the library does not link if it names an entry point of it.
        internal static uint LibraryAbiVersion()
        {
            throw Missing();
        }

        internal static IntPtr VersionString()
        {
            throw Missing();
        }

        internal static int Run(
            ref NativeMesh mesh,
            ref NativeOptions options,
            NativeProgress progress,
            IntPtr user,
            out ResultHandle result,
            ref NativeError error)
        {
            throw Missing();
        }

        internal static int SceneRun(
            IntPtr[] meshes,
            uint meshCount,
            NativeObject[] objects,
            uint objectCount,
            ref NativeOptions options,
            NativeProgress progress,
            IntPtr user,
            IntPtr[] results,
            ref NativeError error)
        {
            throw Missing();
        }

        internal static int ResultMesh(ResultHandle result, ref NativeMesh mesh)
        {
            throw Missing();
        }

        internal static int ResultTotals(ResultHandle result, ref NativeTotals totals)
        {
            throw Missing();
        }

        internal static int ResultVerdicts(ResultHandle result, out IntPtr verdicts, out uint count)
        {
            throw Missing();
        }

        internal static int ResultVertexSources(ResultHandle result, out IntPtr sources, out uint count)
        {
            throw Missing();
        }

        internal static void ResultDestroy(IntPtr result)
        {
            throw Missing();
        }

        internal static int Prepare(ref NativeMesh mesh, out PreparedHandle prepared, ref NativeError error)
        {
            throw Missing();
        }

        internal static int PreparedRun(
            PreparedHandle prepared,
            ref NativeOptions options,
            NativeProgress progress,
            IntPtr user,
            out ResultHandle result,
            ref NativeError error)
        {
            throw Missing();
        }

        internal static void PreparedDestroy(IntPtr prepared)
        {
            throw Missing();
        }

        private static LibraryMissingException Missing()
        {
            return LibraryMissingException.OnThisPlatform();
        }
#endif
    }
}
