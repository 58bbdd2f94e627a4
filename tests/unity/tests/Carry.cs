// Chamfers the meshes of a file of plain numbers, for the comparison with the command line.
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using Unity.Collections;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class Carry
    {
        /// Arguments: the source file, the result file, and the width in percent.
        internal static void Run(string source, string result, string percent)
        {
            var settings = ChamferSettings.Default;
            settings.width = float.Parse(percent, CultureInfo.InvariantCulture);
            using (var reader = new BinaryReader(File.OpenRead(source)))
            using (var writer = new BinaryWriter(File.Create(result)))
            {
                for (int left = reader.ReadInt32(); left > 0; left--)
                {
                    Write(writer, MeshChamfer.Run(Read(reader), settings).Mesh);
                }
            }
        }

        private static Mesh Read(BinaryReader reader)
        {
            var mesh = new Mesh { indexFormat = UnityEngine.Rendering.IndexFormat.UInt32, vertices = Vectors3(reader) };
            mesh.normals = Vectors3(reader);
            mesh.tangents = Vectors4(reader);
            mesh.SetColors(System.Array.ConvertAll(Vectors4(reader), v => new Color(v.x, v.y, v.z, v.w)));
            for (int channel = 0; channel < 8; channel++)
            {
                int components = reader.ReadInt32();
                float[] values = Floats(reader);
                if (components == 2) { mesh.SetUVs(channel, Vectors2(values)); }
            }
            ReadTriangles(reader, mesh);
            ReadBones(reader, mesh);
            for (int target = 0, count = reader.ReadInt32(); target < count; target++) { ReadTarget(reader, mesh, target); }
            return mesh;
        }

        private static void ReadTriangles(BinaryReader reader, Mesh mesh)
        {
            int[] counts = Integers(reader);
            var indices = new List<int>(Integers(reader));
            mesh.subMeshCount = counts.Length;
            for (int submesh = 0, first = 0; submesh < counts.Length; first += counts[submesh], submesh++)
            {
                mesh.SetTriangles(indices.GetRange(first, counts[submesh]).ToArray(), submesh);
            }
        }

        private static void ReadBones(BinaryReader reader, Mesh mesh)
        {
            byte[] counts = System.Array.ConvertAll(Integers(reader), count => (byte)count);
            int[] bones = Integers(reader);
            float[] pulls = Floats(reader);
            if (counts.Length == 0) { return; }
            var weights = new BoneWeight1[bones.Length];
            for (int i = 0; i < bones.Length; i++) { weights[i] = new BoneWeight1 { boneIndex = bones[i], weight = pulls[i] }; }
            mesh.SetBoneWeights(
                new NativeArray<byte>(counts, Allocator.Temp),
                new NativeArray<BoneWeight1>(weights, Allocator.Temp));
        }

        private static void ReadTarget(BinaryReader reader, Mesh mesh, int target)
        {
            Vector3[] positions = Vectors3(reader), normals = Vectors3(reader), tangents = Vectors3(reader);
            mesh.AddBlendShapeFrame("" + target, 100, Full(positions, mesh), Full(normals, mesh), Full(tangents, mesh));
        }

        private static Vector3[] Full(Vector3[] deltas, Mesh mesh)
        {
            return deltas.Length > 0 ? deltas : new Vector3[mesh.vertexCount];
        }

        private static void Write(BinaryWriter writer, Mesh mesh)
        {
            writer.Write(mesh.vertexCount);
            var indices = new List<int>();
            for (int submesh = 0; submesh < mesh.subMeshCount; submesh++) { indices.AddRange(mesh.GetTriangles(submesh)); }
            writer.Write(indices.Count);
            indices.ForEach(writer.Write);
            Write(writer, mesh.vertices);
            Write(writer, mesh.normals);
            Write(writer, mesh.tangents);
            Write(writer, System.Array.ConvertAll(mesh.colors, c => new Vector4(c.r, c.g, c.b, c.a)));
            for (int channel = 0; channel < 2; channel++)
            {
                var uvs = new List<Vector2>();
                mesh.GetUVs(channel, uvs);
                writer.Write(2 * uvs.Count);
                uvs.ForEach(uv => { writer.Write(uv.x); writer.Write(uv.y); });
            }
            WriteBones(writer, mesh);
            WriteTargets(writer, mesh);
        }

        private static void WriteBones(BinaryWriter writer, Mesh mesh)
        {
            var counts = mesh.GetBonesPerVertex().ToArray();
            var weights = mesh.GetAllBoneWeights().ToArray();
            writer.Write(counts.Length);
            foreach (byte count in counts) { writer.Write((int)count); }
            writer.Write(weights.Length);
            foreach (var weight in weights) { writer.Write(weight.boneIndex); }
            writer.Write(weights.Length);
            foreach (var weight in weights) { writer.Write(weight.weight); }
        }

        private static void WriteTargets(BinaryWriter writer, Mesh mesh)
        {
            int count = mesh.vertexCount;
            writer.Write(mesh.blendShapeCount);
            for (int shape = 0; shape < mesh.blendShapeCount; shape++)
            {
                Vector3[] positions = new Vector3[count], normals = new Vector3[count], tangents = new Vector3[count];
                mesh.GetBlendShapeFrameVertices(shape, 0, positions, normals, tangents);
                foreach (var deltas in new[] { positions, normals, tangents }) { Write(writer, deltas); }
            }
        }

        private static void Write(BinaryWriter writer, Vector3[] values)
        {
            writer.Write(3 * values.Length);
            foreach (var value in values) { writer.Write(value.x); writer.Write(value.y); writer.Write(value.z); }
        }

        private static void Write(BinaryWriter writer, Vector4[] values)
        {
            writer.Write(4 * values.Length);
            foreach (var v in values) { writer.Write(v.x); writer.Write(v.y); writer.Write(v.z); writer.Write(v.w); }
        }

        private static float[] Floats(BinaryReader reader)
        {
            var values = new float[reader.ReadInt32()];
            for (int i = 0; i < values.Length; i++) { values[i] = reader.ReadSingle(); }
            return values;
        }

        private static int[] Integers(BinaryReader reader)
        {
            var values = new int[reader.ReadInt32()];
            for (int i = 0; i < values.Length; i++) { values[i] = reader.ReadInt32(); }
            return values;
        }

        private static Vector2[] Vectors2(float[] values)
        {
            var vectors = new Vector2[values.Length / 2];
            for (int i = 0; i < vectors.Length; i++) { vectors[i] = new Vector2(values[2 * i], values[2 * i + 1]); }
            return vectors;
        }

        private static Vector3[] Vectors3(BinaryReader reader)
        {
            float[] f = Floats(reader);
            var vectors = new Vector3[f.Length / 3];
            for (int i = 0; i < vectors.Length; i++) { vectors[i] = new Vector3(f[3 * i], f[3 * i + 1], f[3 * i + 2]); }
            return vectors;
        }

        private static Vector4[] Vectors4(BinaryReader reader)
        {
            float[] f = Floats(reader);
            var vectors = new Vector4[f.Length / 4];
            for (int i = 0; i < vectors.Length; i++) { vectors[i] = new Vector4(f[4 * i], f[4 * i + 1], f[4 * i + 2], f[4 * i + 3]); }
            return vectors;
        }
    }
}
