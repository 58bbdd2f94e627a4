// Small meshes to chamfer.
using System;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class Shapes
    {
        /// A cube from -1 to 1 with four vertices a face.
        internal static Mesh Cube()
        {
            var positions = new Vector3[24];
            var normals = new Vector3[24];
            var corners = new[] { 0, 1, 2, 2, 1, 3 };
            var indices = new int[36];
            for (int v = 0; v < 24; v++)
            {
                int axis = v / 8;
                float side = (v & 4) != 0 ? 1 : -1;
                var position = new float[3];
                var normal = new float[3];
                normal[axis] = position[axis] = side;
                position[(axis + 1) % 3] = (v & 1) != 0 ? side : -side;
                position[(axis + 2) % 3] = (v & 2) != 0 ? 1 : -1;
                positions[v] = new Vector3(position[0], position[1], position[2]);
                normals[v] = new Vector3(normal[0], normal[1], normal[2]);
            }
            for (int i = 0; i < 36; i++) { indices[i] = i / 6 * 4 + corners[i % 6]; }
            var mesh = new Mesh { name = "Cube", vertices = positions, normals = normals };
            mesh.SetTriangles(indices, 0);
            mesh.RecalculateBounds();
            return mesh;
        }

        /// A cube that is open toward -x.
        internal static Mesh OpenCube()
        {
            var mesh = Cube();
            mesh.name = "Open";
            var indices = new int[30];
            Array.Copy(mesh.GetIndices(0), 6, indices, 0, 30);
            mesh.SetTriangles(indices, 0);
            return mesh;
        }

        /// As the cube, with every stream that a mesh can have, each a linear function of the position.
        internal static Mesh FullCube()
        {
            var mesh = Cube();
            var positions = mesh.vertices;
            mesh.tangents = Array.ConvertAll(mesh.normals, n => new Vector4(n.y, n.z, n.x, -1));
            mesh.colors = Array.ConvertAll(positions, p => new Color(0.5f + p.x / 4, 0.5f + p.y / 4, 0.5f + p.z / 4, 1));
            for (int channel = 0; channel < 8; channel++) { SetUvs(mesh, channel, positions); }
            mesh.bindposes = new[] { Matrix4x4.identity, Matrix4x4.identity };
            AddSkin(mesh, positions);
            AddShape(mesh, "smile", 50, Array.ConvertAll(positions, p => p * 0.5f));
            AddShape(mesh, "smile", 100, positions);
            AddShape(mesh, "frown", 100, Array.ConvertAll(positions, p => p * -1));
            return mesh;
        }

        private static void SetUvs(Mesh mesh, int channel, Vector3[] positions)
        {
            if (channel % 3 == 0) { mesh.SetUVs(channel, Array.ConvertAll(positions, p => new Vector2(p.x + p.z, p.y - p.z))); }
            if (channel % 3 == 1) { mesh.SetUVs(channel, Array.ConvertAll(positions, p => p)); }
            if (channel % 3 == 2) { mesh.SetUVs(channel, Array.ConvertAll(positions, p => new Vector4(p.x, p.y, p.z, channel))); }
        }

        /// Bone 0 below, bone 1 above, in proportion to the height.
        private static void AddSkin(Mesh mesh, Vector3[] positions)
        {
            var counts = new byte[positions.Length];
            var weights = new BoneWeight1[positions.Length];
            for (int v = 0; v < positions.Length; v++)
            {
                counts[v] = 1;
                weights[v] = new BoneWeight1 { boneIndex = positions[v].y < 0 ? 0 : 1, weight = 1 };
            }
            mesh.SetBoneWeights(
                new Unity.Collections.NativeArray<byte>(counts, Unity.Collections.Allocator.Temp),
                new Unity.Collections.NativeArray<BoneWeight1>(weights, Unity.Collections.Allocator.Temp));
        }

        private static void AddShape(Mesh mesh, string name, float weight, Vector3[] deltas)
        {
            mesh.AddBlendShapeFrame(name, weight, deltas, new Vector3[deltas.Length], new Vector3[deltas.Length]);
        }

        /// A grid of separate cubes in one mesh.
        internal static Mesh Cubes(int count)
        {
            var cube = Cube();
            var positions = new Vector3[24 * count];
            var normals = new Vector3[24 * count];
            var indices = new int[36 * count];
            for (int c = 0; c < count; c++)
            {
                for (int v = 0; v < 24; v++)
                {
                    positions[24 * c + v] = cube.vertices[v] + new Vector3(3 * (c % 64), 3 * (c / 64), 0);
                    normals[24 * c + v] = cube.normals[v];
                }
                for (int i = 0; i < 36; i++) { indices[36 * c + i] = 24 * c + cube.GetIndices(0)[i]; }
            }
            var mesh = new Mesh { name = "Cubes", indexFormat = UnityEngine.Rendering.IndexFormat.UInt32 };
            mesh.vertices = positions;
            mesh.normals = normals;
            mesh.SetTriangles(indices, 0);
            return mesh;
        }
    }
}
