// What a drag of the width costs on a large mesh, beside the library's own time.
using System;
using System.Diagnostics;
using System.Reflection;
using Chamfer.Interop;
using Chamfer.Streams;
using ChamferEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class Drag
    {
        private const int Cubes = 5625, Steps = 12;

        /// Prints milliseconds and bytes of one step: of the library, of a preview, and of what the stand-in of Mesh
        /// does with the arrays it is given, which is Unity's part.
        internal static void Measure()
        {
            var mesh = Shapes.Cubes(Cubes);
            var modifier = Scene.Holding(mesh, "Large").AddComponent<ChamferModifier>();
            modifier.settings.verify = VerifyMode.Fast;
            var prepared = PreviewSources.Prepare(mesh);
            var arrays = prepared.Run(modifier.settings, false).Mesh;
            ModifierActions.Preview(modifier);
            Print("library", step => Native(mesh, Width(modifier, step)));
            Print("preview", step => { Width(modifier, step); ModifierActions.Preview(modifier); });
            var target = MeshWriter.Write(arrays, mesh);
            Print("mesh", step => MeshWriter.Renew(target, arrays, mesh));
        }

        private static ChamferSettings Width(ChamferModifier modifier, int step)
        {
            modifier.settings.width = 0.01f + 0.0001f * step;
            return modifier.settings;
        }

        private static void Native(Mesh mesh, ChamferSettings settings)
        {
            var options = NativeInput.Options(settings);
            var error = NativeError.Empty();
            ResultHandle result;
            NativeMethods.PreparedRun(PreviewSources.Prepare(mesh).Handle, ref options, null, IntPtr.Zero, out result, ref error);
            result.Dispose();
        }

        /// Of this thread; Mono has it, but does not declare it.
        private static long Allocated()
        {
            var method = typeof(GC).GetMethod("GetAllocatedBytesForCurrentThread", BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic);
            return method != null ? (long)method.Invoke(null, null) : 0;
        }

        private static void Print(string what, Action<int> step)
        {
            step(0);
            var times = new double[Steps];
            long before = Allocated();
            for (int i = 0; i < Steps; i++)
            {
                var watch = Stopwatch.StartNew();
                step(i + 1);
                times[i] = watch.Elapsed.TotalMilliseconds;
            }
            long bytes = (Allocated() - before) / Steps;
            Array.Sort(times);
            Console.WriteLine(what + ": " + times[Steps / 2].ToString("0.0") + " ms, " + bytes + " bytes");
        }
    }
}
