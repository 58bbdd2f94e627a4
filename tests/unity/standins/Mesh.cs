// UnityEngine.Mesh in managed arrays. As in Unity, a mesh that is not readable logs an error, reads as empty, and stays as
// it is when it is written.
using System;
using System.Collections.Generic;
using Unity.Collections;
using UnityEngine.Rendering;

namespace UnityEngine
{
    public sealed class Mesh : Object
    {
        private struct Submesh { public MeshTopology Topology; public int[] Indices; }
        private struct Frame { public string Shape; public float Weight; public Vector3[] Positions, Normals, Tangents; }

        private Vector3[] positions = new Vector3[0], normalValues = new Vector3[0];
        private Vector4[] tangentValues = new Vector4[0];
        private Color[] colorValues = new Color[0];
        private readonly Array[] uvs = new Array[8];
        private Submesh[] submeshes = { new Submesh { Indices = new int[0] } };
        private byte[] bonesPerVertex = new byte[0];
        private BoneWeight1[] boneWeightValues = new BoneWeight1[0];
        private readonly List<Frame> frames = new List<Frame>();

        public bool readable = true, canBeMadeReadable = true, keepVertices = true, keepIndices = true;
        public UnityEditor.ModelImporterMeshCompression compression;

        /// Levels of detail, and of which version of the mesh they were made.
        public int lodCount = 1, lodsOf;

        /// Counts what changed, for EditorUtility.GetDirtyCount.
        public int version;

        public bool isReadable { get { return readable && canBeMadeReadable; } }
        public Bounds bounds { get; set; }
        public IndexFormat indexFormat { get; set; }
        public Matrix4x4[] bindposes { get; set; }
        public VertexAttributeFormat colorFormat;
        public int vertexCount { get { return positions.Length; } }

        public Mesh() { bindposes = new Matrix4x4[0]; }

        private bool Allows(string what)
        {
            if (!isReadable) { Debug.LogError("Not allowed to access " + what + " on mesh '" + name + "'"); }
            return isReadable;
        }

        private bool Writes(string what)
        {
            version++;
            return Allows(what);
        }

        private T[] ReadArray<T>(T[] values, string what) { return Allows(what) ? (T[])values.Clone() : new T[0]; }

        private T[] Checked<T>(T[] values)
        {
            if (values.Length != 0 && values.Length != vertexCount) { throw new ArgumentException("stream length"); }
            return (T[])values.Clone();
        }

        public Vector3[] vertices { get { return ReadArray(positions, "vertices"); } set { if (Writes("vertices")) { positions = (Vector3[])value.Clone(); } } }
        public Vector3[] normals { get { return ReadArray(normalValues, "normals"); } set { if (Writes("normals")) { normalValues = Checked(value); } } }
        public Vector4[] tangents { get { return ReadArray(tangentValues, "tangents"); } set { if (Writes("tangents")) { tangentValues = Checked(value); } } }
        public Color[] colors { get { return ReadArray(colorValues, "colors"); } set { SetColors(value); } }

        public void SetColors(Color[] values)
        {
            if (!Writes("colors")) { return; }
            colorValues = Checked(values);
            colorFormat = VertexAttributeFormat.Float32;
        }

        public Color32[] colors32
        {
            get { return Array.ConvertAll(ReadArray(colorValues, "colors"), color => (Color32)color); }
            set
            {
                if (!Writes("colors")) { return; }
                colorValues = Checked(Array.ConvertAll(value, color => (Color)color));
                colorFormat = VertexAttributeFormat.UNorm8;
            }
        }

        public void SetUVs(int channel, Vector2[] values) { if (Writes("uvs")) { uvs[channel] = Checked(values); } }
        public void SetUVs(int channel, Vector3[] values) { if (Writes("uvs")) { uvs[channel] = Checked(values); } }
        public void SetUVs(int channel, Vector4[] values) { if (Writes("uvs")) { uvs[channel] = Checked(values); } }
        public void GetUVs(int channel, List<Vector2> values) { Fill(channel, values); }
        public void GetUVs(int channel, List<Vector3> values) { Fill(channel, values); }
        public void GetUVs(int channel, List<Vector4> values) { Fill(channel, values); }

        private void Fill<T>(int channel, List<T> values)
        {
            values.Clear();
            if (Allows("uvs") && uvs[channel] != null) { values.AddRange((T[])uvs[channel]); }
        }

        public void Clear()
        {
            if (!Writes("everything")) { return; }
            lodCount = 1;
            positions = normalValues = new Vector3[0];
            tangentValues = new Vector4[0];
            colorValues = new Color[0];
            bonesPerVertex = new byte[0];
            boneWeightValues = new BoneWeight1[0];
            Array.Clear(uvs, 0, uvs.Length);
            submeshes = new[] { new Submesh { Indices = new int[0] } };
        }

        public void ClearBlendShapes() { version++; frames.Clear(); }

        public bool HasVertexAttribute(VertexAttribute attribute)
        {
            switch (attribute)
            {
                case VertexAttribute.Position: return true;
                case VertexAttribute.Normal: return normalValues.Length > 0;
                case VertexAttribute.Tangent: return tangentValues.Length > 0;
                case VertexAttribute.Color: return colorValues.Length > 0;
                case VertexAttribute.BlendWeight:
                case VertexAttribute.BlendIndices: return bonesPerVertex.Length > 0;
                default: return uvs[attribute - VertexAttribute.TexCoord0] != null;
            }
        }

        public int GetVertexAttributeDimension(VertexAttribute attribute)
        {
            var values = uvs[attribute - VertexAttribute.TexCoord0];
            return values is Vector2[] ? 2 : values is Vector3[] ? 3 : values is Vector4[] ? 4 : 0;
        }

        public VertexAttributeFormat GetVertexAttributeFormat(VertexAttribute attribute) { return colorFormat; }

        public int[] triangles { get { return GetIndices(0); } }
        public int subMeshCount { get { return submeshes.Length; } set { Array.Resize(ref submeshes, value); } }
        public MeshTopology GetTopology(int submesh) { return submeshes[submesh].Topology; }
        public int[] GetIndices(int submesh) { return ReadArray(submeshes[submesh].Indices, "indices"); }
        public int[] GetTriangles(int submesh) { return GetIndices(submesh); }
        public uint GetIndexCount(int submesh) { return (uint)submeshes[submesh].Indices.Length; }
        public void SetTriangles(int[] indices, int submesh) { SetIndices(indices, MeshTopology.Triangles, submesh, true); }

        public void SetIndices(int[] indices, MeshTopology topology, int submesh, bool calculateBounds)
        {
            if (!Writes("indices")) { return; }
            foreach (int index in indices)
            {
                if (index < 0 || index >= vertexCount) { throw new ArgumentException("index range"); }
                if (index > ushort.MaxValue && indexFormat == IndexFormat.UInt16) { throw new ArgumentException("16-bit index"); }
            }
            submeshes[submesh] = new Submesh { Topology = topology, Indices = (int[])indices.Clone() };
        }

        public NativeArray<byte> GetBonesPerVertex() { return new NativeArray<byte>(ReadArray(bonesPerVertex, "bones"), Allocator.None); }
        public NativeArray<BoneWeight1> GetAllBoneWeights() { return new NativeArray<BoneWeight1>(ReadArray(boneWeightValues, "bones"), Allocator.None); }

        public void SetBoneWeights(NativeArray<byte> counts, NativeArray<BoneWeight1> weights)
        {
            if (!Writes("bones")) { return; }
            int sum = 0;
            foreach (byte count in counts.ToArray()) { sum += count; }
            if (counts.Length != vertexCount || weights.Length != sum) { throw new ArgumentException("bone weights"); }
            bonesPerVertex = counts.ToArray();
            boneWeightValues = weights.ToArray();
        }

        public int blendShapeCount { get { return Shapes().Count; } }
        public string GetBlendShapeName(int shape) { return Shapes()[shape]; }
        public int GetBlendShapeFrameCount(int shape) { return Frames(shape).Count; }
        public float GetBlendShapeFrameWeight(int shape, int frame) { return Frames(shape)[frame].Weight; }

        public void GetBlendShapeFrameVertices(int shape, int frame, Vector3[] positions, Vector3[] normals, Vector3[] tangents)
        {
            var found = Frames(shape)[frame];
            found.Positions.CopyTo(positions, 0);
            found.Normals.CopyTo(normals, 0);
            found.Tangents.CopyTo(tangents, 0);
        }

        public void AddBlendShapeFrame(string shape, float weight, Vector3[] positions, Vector3[] normals, Vector3[] tangents)
        {
            version++;
            frames.Add(new Frame { Shape = shape, Weight = weight, Positions = Checked(positions), Normals = Checked(normals), Tangents = Checked(tangents) });
        }

        private List<Frame> Frames(int shape)
        {
            string name = Shapes()[shape];
            return frames.FindAll(frame => frame.Shape == name);
        }

        private List<string> Shapes()
        {
            var names = new List<string>();
            foreach (var frame in frames) { if (!names.Contains(frame.Shape)) { names.Add(frame.Shape); } }
            return names;
        }

        public void RecalculateBounds()
        {
            if (!Writes("bounds")) { return; }
            if (positions.Length == 0) { bounds = new Bounds(); return; }
            Vector3 min = positions[0], max = positions[0];
            foreach (var position in positions) { min = Vector3.Min(min, position); max = Vector3.Max(max, position); }
            bounds = new Bounds { min = min, max = max };
        }

        public struct MeshData
        {
            internal Mesh mesh;
            public int vertexCount { get { return mesh.vertexCount; } }
            public int subMeshCount { get { return mesh.subMeshCount; } }
            public bool HasVertexAttribute(VertexAttribute attribute) { return mesh.HasVertexAttribute(attribute); }
            public int GetVertexAttributeDimension(VertexAttribute attribute) { return mesh.GetVertexAttributeDimension(attribute); }
            public void GetVertices(NativeArray<Vector3> values) { values.CopyFrom(mesh.positions); }
            public void GetNormals(NativeArray<Vector3> values) { values.CopyFrom(mesh.normalValues); }
            public void GetTangents(NativeArray<Vector4> values) { values.CopyFrom(mesh.tangentValues); }
            public void GetColors(NativeArray<Color> values) { values.CopyFrom(mesh.colorValues); }
            public void GetColors(NativeArray<Color32> values) { throw new NotImplementedException(); }
            public void GetUVs(int channel, NativeArray<Vector2> values) { values.CopyFrom((Vector2[])mesh.uvs[channel]); }
            public void GetUVs(int channel, NativeArray<Vector3> values) { values.CopyFrom((Vector3[])mesh.uvs[channel]); }
            public void GetUVs(int channel, NativeArray<Vector4> values) { values.CopyFrom((Vector4[])mesh.uvs[channel]); }
            public void GetIndices(NativeArray<int> values, int submesh, bool applyBaseVertex) { values.CopyFrom(mesh.submeshes[submesh].Indices); }

            public SubMeshDescriptor GetSubMesh(int index)
            {
                var submesh = mesh.submeshes[index];
                return new SubMeshDescriptor { topology = submesh.Topology, indexCount = submesh.Indices.Length };
            }
        }

        public struct MeshDataArray : IDisposable
        {
            internal Mesh mesh;
            public MeshData this[int index] { get { return new MeshData { mesh = mesh }; } }
            public void Dispose() { }
        }

        public static MeshDataArray Snapshot(Mesh mesh) { return new MeshDataArray { mesh = mesh }; }
    }
}
