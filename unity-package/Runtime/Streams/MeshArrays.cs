using System;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Everything that a mesh holds, as managed arrays that any thread may use. Absent streams are null.</summary>
    internal sealed class MeshArrays
    {
        public string Name;
        public Bounds Bounds;

        /// <summary>Whether indices have 32 bits: some games ask for that on purpose.</summary>
        public bool HasWideIndices;

        public Vector3[] Positions = new Vector3[0];
        public Vector3[] Normals;
        public Vector4[] Tangents;
        public Color[] Colors;

        /// <summary>Whether the colours are stored in eight bits a channel.</summary>
        public bool HasByteColors;

        /// <summary><c>#channels</c>: of Vector2, Vector3 or Vector4, or null.</summary>
        public readonly Array[] Uvs = new Array[Interop.NativeMesh.UvChannels.Count];

        public SubmeshArrays[] Submeshes = new SubmeshArrays[0];
        public Skin Skin;
        public BlendShapeFrame[] BlendShapes = new BlendShapeFrame[0];
    }

    /// <summary>The indices of one submesh.</summary>
    internal struct SubmeshArrays
    {
        public MeshTopology Topology;
        public int[] Indices;

        public bool IsTriangles => Topology == MeshTopology.Triangles;
    }

    /// <summary>Bone weights in Unity's variable layout, and the bind poses.</summary>
    internal sealed class Skin
    {
        /// <summary><c>#vertices</c>, or empty where the mesh has bind poses only.</summary>
        public byte[] BonesPerVertex;
        public BoneWeight1[] Weights;
        public Matrix4x4[] Bindposes;
    }

    /// <summary>One frame of a blend shape: what it adds to each vertex.</summary>
    internal sealed class BlendShapeFrame
    {
        public string Shape;
        public float Weight;
        public Vector3[] Positions;
        public Vector3[] Normals;
        public Vector3[] Tangents;
    }
}
