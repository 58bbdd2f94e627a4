using System;
using System.Linq;
using System.Threading;
using Chamfer.Interop;
using Chamfer.Streams;
using UnityEngine;
using UnityEngine.Rendering;

namespace Chamfer.Tests
{
    internal static class RuntimeTests
    {
        private static ChamferSettings Width(float width)
        {
            var settings = ChamferSettings.Default;
            settings.unit = WidthUnit.MeshUnits;
            settings.width = width;
            return settings;
        }

        private static ChamferResult Run(Mesh mesh) { return MeshChamfer.Run(mesh, Width(0.1f)); }

        public static void A_cube_gains_triangles_only()
        {
            var result = Run(Shapes.Cube());
            Check.Equal(24, result.Mesh.vertexCount);
            Check.Equal(44 * 3, result.Mesh.GetTriangles(0).Length);
            Check.Equal("Cube", result.Mesh.name);
            Check.Equal(0.9f, result.Mesh.vertices.Max(p => Math.Min(Math.Abs(p.x), Math.Abs(p.y))));
            Check.That(result.Mesh.indexFormat == IndexFormat.UInt16, "16 bits suffice");
        }

        public static void The_report_counts()
        {
            var report = Run(Shapes.Cube()).Report;
            Check.Equal("12 hard edges: 12 full, 0 narrowed, 0 skipped; 12 -> 44 triangles", report.ToString());
            Check.Equal(24, report.VerticesBefore);
            Check.Equal(24, report.VerticesAfter);
            Check.Equal(12, report.Verdicts.Count);
            Check.Equal(12, report.Count(EdgeOutcome.Full, EdgeReason.None));
            Check.Near(0.1f, report.Verdicts[0].FirstWidth);
            Check.Near(0.1f, report.Width);
            Check.Near(1, report.MeanWidth);
            Check.That(report.Milliseconds > 0, "it takes time");
        }

        public static void Too_wide_a_chamfer_is_narrowed_with_its_reason()
        {
            var report = MeshChamfer.Run(Shapes.Cube(), Width(5)).Report;
            Check.Equal(12, report.Narrowed);
            Check.That(report.Verdicts.All(verdict => verdict.Reason != EdgeReason.None), "each has a reason");
        }

        public static void The_source_is_not_changed()
        {
            var mesh = Shapes.FullCube();
            var before = MeshReader.Read(mesh);
            Run(mesh);
            var after = MeshReader.Read(mesh);
            Check.That(before.Positions.SequenceEqual(after.Positions), "positions");
            Check.That(before.Colors.SequenceEqual(after.Colors), "colours");
            Check.That(before.Skin.Weights.SequenceEqual(after.Skin.Weights), "weights");
            Check.That(before.Submeshes[0].Indices.SequenceEqual(after.Submeshes[0].Indices), "indices");
        }

        public static void Every_stream_follows_the_positions()
        {
            var mesh = Run(Shapes.FullCube()).Mesh;
            var arrays = MeshReader.Read(mesh);
            Check.Equal(mesh.vertexCount, arrays.Tangents.Length);
            for (int v = 0; v < mesh.vertexCount; v++)
            {
                Check.Equal(-1f, arrays.Tangents[v].w);
                Check.Near(1, arrays.Normals[v].magnitude);
            }
            Check.That(arrays.Uvs[0] is Vector2[] && arrays.Uvs[4] is Vector3[] && arrays.Uvs[5] is Vector4[], "components");
            Check.Equal(5f, ((Vector4[])arrays.Uvs[5])[7].w);
        }

        public static void Width_zero_gives_the_mesh_itself()
        {
            var source = MeshReader.Read(Shapes.FullCube());
            var output = MeshReader.Read(MeshChamfer.Run(Shapes.FullCube(), Width(0)).Mesh);
            Check.That(source.Positions.SequenceEqual(output.Positions), "positions");
            Check.That(source.Colors.SequenceEqual(output.Colors), "colours");
            Check.That(source.Tangents.SequenceEqual(output.Tangents), "tangents");
            Check.That(source.Skin.Weights.SequenceEqual(output.Skin.Weights), "weights");
            for (int channel = 0; channel < 8; channel++)
            {
                Check.That(source.Uvs[channel].Cast<object>().SequenceEqual(output.Uvs[channel].Cast<object>()), "channel " + channel);
            }
        }

        public static void Byte_colours_stay_bytes()
        {
            var mesh = Shapes.FullCube();
            mesh.colors32 = mesh.colors32;
            Check.That(MeshReader.HasByteColors(Run(mesh).Mesh), "bytes");
            Check.That(!MeshReader.HasByteColors(Run(Shapes.FullCube()).Mesh), "floats");
        }

        public static void Blend_shapes_follow_with_all_their_frames()
        {
            var mesh = Run(Shapes.FullCube()).Mesh;
            Check.Equal(2, mesh.blendShapeCount);
            Check.Equal("smile", mesh.GetBlendShapeName(0));
            Check.Equal(2, mesh.GetBlendShapeFrameCount(0));
            Check.Equal(50f, mesh.GetBlendShapeFrameWeight(0, 0));
            int count = mesh.vertexCount;
            Vector3[] positions = new Vector3[count], normals = new Vector3[count], tangents = new Vector3[count];
            mesh.GetBlendShapeFrameVertices(0, 1, positions, normals, tangents);
            // The shape adds the position itself, so what it adds must move with it.
            for (int v = 0; v < count; v++) { Check.That((positions[v] - mesh.vertices[v]).magnitude < 1e-5f, "vertex " + v); }
        }

        public static void Bone_weights_blend_strongest_first_and_sum_to_one()
        {
            var mesh = Run(Shapes.FullCube()).Mesh;
            var counts = mesh.GetBonesPerVertex();
            var weights = mesh.GetAllBoneWeights();
            Check.Equal(2, mesh.bindposes.Length);
            for (int v = 0, first = 0; v < mesh.vertexCount; first += counts[v], v++)
            {
                var bones = weights.ToArray().Skip(first).Take(counts[v]).ToArray();
                Check.Near(1, bones.Sum(bone => bone.weight));
                Check.That(bones.SequenceEqual(bones.OrderByDescending(bone => bone.weight)), "order");
                float height = bones.Where(bone => bone.boneIndex == 1).Sum(bone => bone.weight);
                Check.Near((mesh.vertices[v].y + 1) / 2, height);
            }
        }

        public static void Chamfers_can_have_a_submesh_of_their_own()
        {
            var settings = Width(0.1f);
            settings.submeshMode = ChamferSubmesh.Own;
            var mesh = MeshChamfer.Run(Shapes.Cube(), settings).Mesh;
            Check.Equal(2, mesh.subMeshCount);
            Check.Equal(36, mesh.GetTriangles(0).Length);
            Check.Equal(32 * 3, mesh.GetTriangles(1).Length);
        }

        /// Two submeshes of triangles around one of lines are one solid.
        public static void Edges_between_submeshes_are_chamfered()
        {
            var source = Shapes.Cube();
            var indices = source.GetIndices(0);
            source.subMeshCount = 3;
            source.SetIndices(new[] { 0, 1 }, MeshTopology.Lines, 1, false);
            source.SetTriangles(indices.Take(18).ToArray(), 0);
            source.SetTriangles(indices.Skip(18).ToArray(), 2);
            var result = Run(source);
            Check.Equal(12, result.Report.Chamfered);
            Check.Equal(132, result.Mesh.GetIndices(0).Length + result.Mesh.GetIndices(2).Length);
        }

        public static void Lines_stay_where_they_were()
        {
            var source = Shapes.FullCube();
            source.subMeshCount = 2;
            source.SetIndices(new[] { 0, 1, 1, 3 }, MeshTopology.Lines, 1, false);
            var mesh = Run(source).Mesh;
            Check.Equal(MeshTopology.Lines, mesh.GetTopology(1));
            var indices = mesh.GetIndices(1);
            Check.Equal(4, indices.Length);
            // The three that the lines use, and what the cube alone becomes.
            Check.Equal(Run(Shapes.FullCube()).Mesh.vertexCount + 3, mesh.vertexCount);
            Check.Equal(source.vertices[3], mesh.vertices[indices[3]]);
            Check.Equal(source.colors[3], mesh.colors[indices[3]]);
            Check.Equal(132, mesh.GetIndices(0).Length);
        }

        public static void Points_and_strips_of_lines_pass()
        {
            var source = Shapes.FullCube();
            source.subMeshCount = 3;
            source.SetIndices(new[] { 5 }, MeshTopology.Points, 1, false);
            source.SetIndices(new[] { 0, 1, 3 }, MeshTopology.LineStrip, 2, false);
            var result = Run(source);
            Check.Equal(MeshTopology.Points, result.Mesh.GetTopology(1));
            Check.Equal(source.vertices[5], result.Mesh.vertices[result.Mesh.GetIndices(1)[0]]);
            Check.Equal(3, result.Mesh.GetIndices(2).Length);
            Check.Equal(0, result.Report.Quads);
        }

        public static void Bounds_never_shrink()
        {
            var mesh = Shapes.Cube();
            mesh.bounds = new Bounds(new Vector3(0, 0, 0), new Vector3(10, 10, 10));
            Check.Equal(10f, Run(mesh).Mesh.bounds.size.x);
        }

        public static void Many_vertices_need_wide_indices()
        {
            var mesh = Run(Shapes.Cubes(3000)).Mesh;
            Check.Equal(72000, mesh.vertexCount);
            Check.That(mesh.indexFormat == IndexFormat.UInt32, "32 bits");
            Check.Equal(3000 * 132, mesh.GetIndices(0).Length);
            var arrays = MeshReader.Read(mesh);
            arrays.HasWideIndices = false;
            Check.That(MeshWriter.Write(arrays, mesh).indexFormat == IndexFormat.UInt32, "though the source had 16");
        }

        public static void The_editor_reads_meshes_without_read_write()
        {
            var mesh = Shapes.Cube();
            mesh.SetUVs(1, new Vector3[24]);
            mesh.readable = false;
            var result = Run(mesh).Mesh;
            Check.Equal(132, MeshReader.Read(result).Submeshes[0].Indices.Length);
            Check.Equal(3, result.GetVertexAttributeDimension(VertexAttribute.TexCoord1));
        }

        public static void All_streams_are_read_without_read_write()
        {
            var mesh = Shapes.Cube();
            mesh.tangents = Array.ConvertAll(mesh.normals, n => new Vector4(n.y, n.z, n.x, -1));
            mesh.colors32 = Array.ConvertAll(mesh.vertices, p => (Color32)new Color(p.x, p.y, p.z, 1));
            mesh.SetUVs(0, Array.ConvertAll(mesh.vertices, p => new Vector2(p.x, p.y)));
            mesh.SetUVs(1, mesh.vertices);
            mesh.SetUVs(2, Array.ConvertAll(mesh.vertices, p => new Vector4(p.x, p.y, p.z, 1)));
            mesh.indexFormat = IndexFormat.UInt32;
            var expected = MeshReader.Read(mesh);
            mesh.readable = false;
            var found = MeshReader.Read(mesh);
            Check.Equal(ContentHash.Of(expected), ContentHash.Of(found));
            Check.That(found.HasByteColors && found.HasWideIndices, "flags");
            Check.Equal("Cube", found.Name);
        }

        public static void The_editor_reads_skins_and_blend_shapes_without_read_write()
        {
            var mesh = Shapes.FullCube();
            mesh.readable = false;
            var result = Run(mesh).Mesh;
            Check.Equal(2, result.blendShapeCount);
            Check.Equal(result.vertexCount, MeshReader.Read(result).Skin.BonesPerVertex.Length);
            Check.That(!mesh.readable && mesh != null, "the source is as it was");
        }

        public static void A_result_is_stored_as_its_source()
        {
            foreach (bool flag in new[] { false, true })
            {
                var mesh = Shapes.Cube();
                mesh.readable = mesh.keepVertices = flag;
                mesh.keepIndices = !flag;
                mesh.compression = flag ? UnityEditor.ModelImporterMeshCompression.High : UnityEditor.ModelImporterMeshCompression.Off;
                mesh.indexFormat = flag ? IndexFormat.UInt32 : IndexFormat.UInt16;
                var result = Run(mesh).Mesh;
                Check.Equal(flag, result.isReadable);
                Check.Equal(flag, result.keepVertices);
                Check.Equal(!flag, result.keepIndices);
                Check.Equal(mesh.compression, result.compression);
                Check.Equal(mesh.indexFormat, result.indexFormat);
                Check.Equal(mesh.indexFormat, MeshChamfer.RunScene(new[] { new PlacedMesh(mesh, Matrix4x4.identity) }, Width(0.1f))[mesh].Mesh.indexFormat);
            }
        }

        public static void What_cannot_be_read_can_be_written_all_the_same()
        {
            Mesh source = Shapes.FullCube(), target = Shapes.FullCube();
            source.readable = target.readable = false;
            var arrays = MeshReader.Read(Run(source).Mesh);
            MeshWriter.Overwrite(target, arrays, source);
            Check.Equal(132, MeshReader.Read(target).Submeshes[0].Indices.Length);
            Check.Equal(2, target.blendShapeCount);
            Check.That(!target.isReadable, "as before");
            source.readable = true;
            MeshWriter.Overwrite(target, arrays, source);
            Check.That(target.isReadable, "as the source");
        }

        /// One stream after the other: what a mesh held before must not stay.
        public static void Overwriting_leaves_nothing_of_before()
        {
            var target = Shapes.FullCube();
            MeshWriter.Overwrite(target, MeshReader.Read(Shapes.Cube()), target);
            var found = MeshReader.Read(target);
            Check.That(found.Tangents == null && found.Colors == null && found.Skin.BonesPerVertex.Length == 0, "streams");
            Check.That(found.Uvs.All(uvs => uvs == null), "channels");
            Check.Equal(0, target.blendShapeCount);
        }

        public static void What_even_a_copy_does_not_show_is_refused()
        {
            var mesh = Shapes.FullCube();
            mesh.readable = false;
            mesh.canBeMadeReadable = false;
            var exception = Check.Throws<MeshNotReadableException>(() => Run(mesh));
            Check.That(exception.Message.Contains("Read/Write"), exception.Message);
        }

        public static void A_mesh_without_normals_is_refused()
        {
            var mesh = Shapes.Cube();
            mesh.normals = new Vector3[0];
            var exception = Check.Throws<InvalidMeshException>(() => Run(mesh));
            Check.That(exception.Message.Contains("'Cube'") && exception.Message.Contains("normals"), exception.Message);
        }

        public static void A_bad_position_is_refused_by_its_vertex()
        {
            var mesh = Shapes.Cube();
            var positions = mesh.vertices;
            positions[7].y = float.NaN;
            mesh.vertices = positions;
            Check.Equal(7, Check.Throws<InvalidMeshException>(() => Run(mesh)).Element);
        }

        public static void Bad_settings_are_refused()
        {
            Check.Throws<InvalidSettingsException>(() => MeshChamfer.Run(Shapes.Cube(), Width(-1)));
            Check.Throws<InvalidSettingsException>(() => MeshChamfer.Run(Shapes.Cube(), Width(float.NaN)));
            var settings = Width(0.1f);
            settings.submeshMode = ChamferSubmesh.Given;
            settings.submesh = 1;
            Check.Throws<InvalidSettingsException>(() => MeshChamfer.Run(Shapes.Cube(), settings));
            settings.verify = (VerifyMode)9;
            Check.Throws<InvalidSettingsException>(() => MeshChamfer.Run(Shapes.Cube(), settings));
            Check.Throws<ArgumentNullException>(() => MeshChamfer.Run(null, settings));
        }

        public static void Library_faults_have_types()
        {
            Check.Throws<LibraryMissingException>(() => LibraryCheck.Check(() => { throw new DllNotFoundException(); }));
            Check.Throws<LibraryMissingException>(() => LibraryCheck.Check(() => { throw new BadImageFormatException(); }));
            Check.Throws<LibraryVersionException>(() => LibraryCheck.Check(() => { throw new EntryPointNotFoundException(); }));
            Check.Throws<LibraryVersionException>(() => LibraryCheck.Check(() => NativeMethods.AbiVersion + 1));
            var none = NativeError.Empty();
            Check.That(Failure.Of(300, none, "", CancellationToken.None) is ResultTooLargeException, "300");
            Check.That(Failure.Of(900, none, "", CancellationToken.None) is LibraryFaultException, "900");
        }

        public static void Progress_rises_to_one()
        {
            var told = new Told();
            MeshChamfer.Run(Shapes.Cubes(100), Width(0.1f), told);
            Check.That(told.Values.Count > 2, "told " + told.Values.Count + " times");
            Check.That(told.Values.SequenceEqual(told.Values.OrderBy(value => value)), "rises");
        }

        public static void Cancelling_half_way_stops()
        {
            var source = new CancellationTokenSource();
            var told = new Told { OnReport = done => { if (done > 0) { source.Cancel(); } } };
            Check.Throws<OperationCanceledException>(() => MeshChamfer.Run(Shapes.Cubes(100), Width(0.1f), told, source.Token));
            Check.Throws<OperationCanceledException>(() => MeshChamfer.Run(Shapes.Cube(), Width(0.1f), null, source.Token));
        }

        public static void What_a_progress_throws_comes_through()
        {
            var told = new Told { OnReport = done => { throw new InvalidTimeZoneException("mine"); } };
            Check.Throws<InvalidTimeZoneException>(() => MeshChamfer.Run(Shapes.Cube(), Width(0.1f), told));
        }

        public static void The_async_variant_works_off_this_thread()
        {
            int here = Thread.CurrentThread.ManagedThreadId, there = here;
            var told = new Told { OnReport = done => there = Thread.CurrentThread.ManagedThreadId };
            var result = MeshChamfer.RunAsync(Shapes.Cube(), Width(0.1f), told).Result;
            Check.Equal(132, result.Mesh.GetTriangles(0).Length);
            Check.That(here != there, "another thread");
        }

        public static void Repeated_runs_give_the_same_and_do_not_grow()
        {
            var mesh = Shapes.FullCube();
            var first = Run(mesh).Mesh.vertices;
            for (int i = 0; i < 100; i++) { Run(mesh); }
            long before = ResidentBytes();
            for (int i = 0; i < 1000; i++) { Check.That(Run(mesh).Mesh.vertices.SequenceEqual(first), "run " + i); }
            Check.That(ResidentBytes() - before < 16 << 20, "grew by " + (ResidentBytes() - before) + " bytes");
        }

        private static long ResidentBytes()
        {
            GC.Collect();
            return System.Diagnostics.Process.GetCurrentProcess().WorkingSet64;
        }
    }
}
