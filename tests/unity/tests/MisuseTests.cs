// What misuse of the C interface leads to, as far as C# can commit it: the rows of docs/abi.md.
using System;
using System.Threading;
using Chamfer.Interop;
using Chamfer.Streams;

namespace Chamfer.Tests
{
    internal static unsafe class MisuseTests
    {
        private const int Cancelled = 1, NullPointer = 100, Misaligned = 101, StructSize = 102, CountOverflow = 103,
            BadWidth = 104, BadOption = 105, SubmeshRange = 106, MissingNormals = 200, UvComponents = 202, NotFinite = 203,
            IndexTotal = 204, IndexCount = 205, IndexRange = 206;

        private sealed class Call
        {
            internal NativeMesh Mesh;
            internal NativeOptions Options = NativeInput.Options(ChamferSettings.Default);
            internal NativeError Error = NativeError.Empty();
            internal NativeProgress Progress;
        }

        /// The status of a call on a cube with all streams that was changed before.
        private static int Status(Action<Call> change)
        {
            using (var pins = new PinnedArrays())
            {
                var call = new Call { Mesh = NativeInput.Mesh(MeshReader.Read(Shapes.FullCube()), pins) };
                change(call);
                ResultHandle result;
                int status = NativeMethods.Run(
                    ref call.Mesh, ref call.Options, call.Progress, IntPtr.Zero, out result, ref call.Error);
                Check.That(result.IsInvalid == (status != 0), "a result exactly on success");
                result.Dispose();
                return status;
            }
        }

        private static void SetUv(Call call, int channel, uint components, IntPtr values)
        {
            call.Mesh.Uvs[channel] = new NativeUv { Components = components, Values = values };
        }

        public static void A_sound_call_succeeds()
        {
            Check.Equal(0, Status(call => { }));
        }

        public static void Arrays_that_are_missing()
        {
            Check.Equal(NullPointer, Status(call => call.Mesh.Positions = IntPtr.Zero));
            Check.Equal(NullPointer, Status(call => call.Mesh.Indices = IntPtr.Zero));
            Check.Equal(NullPointer, Status(call => call.Mesh.SubmeshIndexCounts = IntPtr.Zero));
            Check.Equal(NullPointer, Status(call => SetUv(call, 0, 2, IntPtr.Zero)));
            Check.Equal(MissingNormals, Status(call => call.Mesh.Normals = IntPtr.Zero));
            Check.Equal(0, Status(call => call.Mesh.Tangents = call.Mesh.Colors = IntPtr.Zero));
        }

        public static void Arrays_that_are_not_aligned()
        {
            Check.Equal(Misaligned, Status(call => call.Mesh.Positions += 1));
            Check.Equal(Misaligned, Status(call => call.Mesh.Normals += 2));
            Check.Equal(Misaligned, Status(call => call.Mesh.Tangents += 1));
            Check.Equal(Misaligned, Status(call => call.Mesh.Colors += 3));
            Check.Equal(Misaligned, Status(call => call.Mesh.Indices += 1));
            Check.Equal(Misaligned, Status(call => call.Mesh.SubmeshIndexCounts += 1));
            Check.Equal(Misaligned, Status(call => SetUv(call, 7, 2, call.Mesh.Positions + 1)));
        }

        public static void Held_places()
        {
            Check.Equal(NullPointer, Status(call => call.Mesh.HeldCount = 1));
            Check.Equal(Misaligned, Status(call => { call.Mesh.HeldCount = 1; call.Mesh.Held = call.Mesh.Positions + 1; }));
            Check.Equal(0, Status(call => { call.Mesh.HeldCount = 1; call.Mesh.Held = call.Mesh.Positions; }));
        }

        public static void Sizes_of_structs()
        {
            foreach (uint size in new[] { 0u, 7u, 0xFFFFFFFFu })
            {
                Check.Equal(StructSize, Status(call => call.Mesh.StructSize = size));
                Check.Equal(StructSize, Status(call => call.Options.StructSize = size));
                Check.Equal(StructSize, Status(call => call.Error.StructSize = size));
            }
        }

        /// As a program with a newer header would call: what this library does not know must not be set.
        public static void Fields_of_a_newer_header()
        {
            Check.Equal(0, WithLongerOptions(0));
            Check.Equal(StructSize, WithLongerOptions(1));
        }

        private static int WithLongerOptions(uint unknown)
        {
            var memory = stackalloc NativeOptions[2];
            memory[0] = NativeInput.Options(ChamferSettings.Default);
            memory[1] = new NativeOptions { StructSize = unknown };
            memory[0].StructSize += 4;
            using (var pins = new PinnedArrays())
            {
                var mesh = NativeInput.Mesh(MeshReader.Read(Shapes.Cube()), pins);
                var error = NativeError.Empty();
                ResultHandle result;
                int status = NativeMethods.Run(ref mesh, ref memory[0], null, IntPtr.Zero, out result, ref error);
                result.Dispose();
                return status;
            }
        }

        public static void Counts()
        {
            Check.Equal(CountOverflow, Status(call => { call.Mesh.Positions = (IntPtr)(-16); call.Mesh.VertexCount = 0xFFFFFFFF; }));
            Check.Equal(IndexTotal, Status(call => call.Mesh.IndexCount -= 3));
            Check.Equal(IndexCount, WithIndices(new[] { 0, 1, 2, 3 }));
            Check.Equal(IndexRange, WithIndices(new[] { 0, 1, 24 }));
            Check.Equal(IndexRange, WithIndices(new[] { 0, 1, -1 }));
            Check.Equal(UvComponents, Status(call => SetUv(call, 3, 5, call.Mesh.Positions)));
            Check.Equal(UvComponents, Status(call => SetUv(call, 3, 1, call.Mesh.Positions)));
        }

        private static int WithIndices(int[] indices)
        {
            using (var pins = new PinnedArrays())
            {
                return Status(call =>
                {
                    call.Mesh.Indices = pins.Pin(indices);
                    call.Mesh.IndexCount = (uint)indices.Length;
                    call.Mesh.SubmeshIndexCounts = pins.Pin(new[] { indices.Length });
                });
            }
        }

        public static void Options()
        {
            Check.Equal(BadOption, Status(call => call.Options.WidthUnit = 2));
            Check.Equal(BadOption, Status(call => call.Options.Verify = 3));
            Check.Equal(BadOption, Status(call => call.Options.SubmeshMode = 3));
            Check.Equal(BadWidth, Status(call => call.Options.Width = -1));
            Check.Equal(BadWidth, Status(call => call.Options.Width = float.NaN));
            Check.Equal(BadWidth, Status(call => call.Options.Width = float.PositiveInfinity));
            Check.Equal(SubmeshRange, Status(call => { call.Options.SubmeshMode = 2; call.Options.Submesh = 1; }));
        }

        public static void Values_that_are_not_finite()
        {
            foreach (float bad in new[] { float.NaN, float.PositiveInfinity, float.NegativeInfinity })
            {
                Check.Equal(NotFinite, Status(call => ((float*)call.Mesh.Positions)[5] = bad));
                Check.Equal(NotFinite, Status(call => ((float*)call.Mesh.Normals)[5] = bad));
                Check.Equal(NotFinite, Status(call => ((float*)call.Mesh.Tangents)[5] = bad));
                Check.Equal(NotFinite, Status(call => ((float*)call.Mesh.Colors)[5] = bad));
                Check.Equal(NotFinite, Status(call => ((float*)call.Mesh.Uvs[6].Values)[5] = bad));
            }
        }

        public static void Callbacks()
        {
            Check.Equal(0, Status(call => call.Progress = null));
            Check.Equal(Cancelled, Status(call => call.Progress = (user, done) => 1));
        }

        public static void A_callback_that_stops_at_any_of_its_calls()
        {
            int calls = 0;
            Check.Equal(0, Status(call => call.Progress = (user, done) => { calls++; return 0; }));
            for (int last = 1; last <= calls; last++)
            {
                int left = last;
                Check.Equal(Cancelled, Status(call => call.Progress = (user, done) => --left == 0 ? 1 : 0));
            }
        }

        public static void What_is_unusual_but_allowed()
        {
            Check.Equal(0, Status(call => call.Options.Width = 1e30f));
            Check.Equal(0, Status(call => call.Mesh.Colors = call.Mesh.Tangents));
            Check.Equal(0, Status(call => SetUv(call, 1, 3, call.Mesh.Positions)));
            NativeMethods.ResultDestroy(IntPtr.Zero);
        }

        public static void Several_threads_look_at_one_result()
        {
            using (var result = Run())
            {
                int different = 0;
                var threads = new Thread[4];
                for (int i = 0; i < threads.Length; i++)
                {
                    threads[i] = new Thread(() =>
                    {
                        var mesh = NativeMesh.Empty();
                        NativeMethods.ResultMesh(result, ref mesh);
                        if (mesh.IndexCount != 132) { Interlocked.Increment(ref different); }
                    });
                    threads[i].Start();
                }
                foreach (var thread in threads) { thread.Join(); }
                Check.Equal(0, different);
            }
        }

        private static ResultHandle Run()
        {
            using (var pins = new PinnedArrays())
            {
                var mesh = NativeInput.Mesh(MeshReader.Read(Shapes.Cube()), pins);
                var options = NativeInput.Options(ChamferSettings.Default);
                var error = NativeError.Empty();
                ResultHandle result;
                Check.Equal(0, NativeMethods.Run(ref mesh, ref options, null, IntPtr.Zero, out result, ref error));
                return result;
            }
        }

        /// .NET counts the uses of a handle: it is freed once, and refuses to be used after that.
        public static void Results_after_their_end()
        {
            var result = Run();
            result.Dispose();
            result.Dispose();
            var mesh = NativeMesh.Empty();
            Check.Throws<ObjectDisposedException>(() => NativeMethods.ResultMesh(result, ref mesh));
        }

        /// Every status of the library becomes an exception of the band's type.
        public static void Statuses_become_typed_exceptions()
        {
            var error = NativeError.Empty();
            Func<int, Exception> of = status => Failure.Of(status, error, "mesh", CancellationToken.None);
            Check.That(of(Cancelled) is OperationCanceledException, "1");
            for (int status = NullPointer; status < MissingNormals; status++) { Check.That(of(status) is InvalidSettingsException, "" + status); }
            for (int status = MissingNormals; status < 300; status++) { Check.That(of(status) is InvalidMeshException, "" + status); }
            for (int status = 300; status < 900; status++) { Check.That(of(status) is ResultTooLargeException, "" + status); }
            Check.That(of(900) is LibraryFaultException, "900");
        }
    }
}
