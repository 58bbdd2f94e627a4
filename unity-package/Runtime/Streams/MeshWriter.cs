using System;
using Unity.Collections;
using UnityEngine;
using UnityEngine.Rendering;

namespace Chamfer.Streams
{
    /// <summary>Writes arrays to meshes, on the main thread.</summary>
    internal static class MeshWriter
    {
        /// <summary>The most vertices that 16-bit indices reach: Unity keeps the last one for itself.</summary>
        private const int MostShortVertices = 65535;

        /// <summary>A new mesh, with the flags of its source: whether scripts may read it, and how it is compressed.</summary>
        internal static Mesh Write(MeshArrays arrays, Mesh source)
        {
            var mesh = new Mesh { name = arrays.Name };
            Fill(mesh, arrays);
            MeshLods.Make(mesh, MeshLods.Count(source));
            MeshFlags.Copy(source, mesh);
            return mesh;
        }

        /// <summary>
        /// As <see cref="Overwrite"/>, of a mesh that was written from the same source a moment ago: its flags are those
        /// of the source already, and looking at them takes longer than writing.
        /// </summary>
        internal static void Renew(Mesh mesh, MeshArrays arrays, Mesh source)
        {
            if (!mesh.isReadable || MeshLods.Count(source) > 1)
            {
                Overwrite(mesh, arrays, source);
                return;
            }
            Replace(mesh, arrays);
        }

        /// <summary>
        /// Replaces everything that a mesh holds: importers know their meshes by identity. The source may be the mesh
        /// itself.
        /// </summary>
        internal static void Overwrite(Mesh mesh, MeshArrays arrays, Mesh source)
        {
            bool isReadable = source.isReadable;
            int levels = MeshLods.Count(source);
            // Unity refuses to write what it does not let anybody read.
            MeshFlags.SetReadable(mesh, true);
            Replace(mesh, arrays);
            MeshLods.Make(mesh, levels);
            MeshFlags.Copy(source, mesh);
            MeshFlags.SetReadable(mesh, isReadable);
        }

        /// <summary>What the mesh held must not stay where the arrays hold nothing.</summary>
        private static void Replace(Mesh mesh, MeshArrays arrays)
        {
            mesh.Clear();
            mesh.ClearBlendShapes();
            Fill(mesh, arrays);
        }

        private static void Fill(Mesh mesh, MeshArrays arrays)
        {
            bool isWide = arrays.HasWideIndices || arrays.Positions.Length > MostShortVertices;
            mesh.indexFormat = isWide ? IndexFormat.UInt32 : IndexFormat.UInt16;
            WriteVertices(mesh, arrays);
            WriteSubmeshes(mesh, arrays.Submeshes);
            if (arrays.Skin != null) { WriteSkin(mesh, arrays.Skin); }
            foreach (var frame in arrays.BlendShapes)
            {
                mesh.AddBlendShapeFrame(frame.Shape, frame.Weight, frame.Positions, frame.Normals, frame.Tangents);
            }
            WriteBounds(mesh, arrays.Bounds);
        }

        private static void WriteVertices(Mesh mesh, MeshArrays arrays)
        {
            mesh.vertices = arrays.Positions;
            if (arrays.Normals != null) { mesh.normals = arrays.Normals; }
            if (arrays.Tangents != null) { mesh.tangents = arrays.Tangents; }
            if (arrays.Colors != null) { WriteColors(mesh, arrays); }
            for (int channel = 0; channel < arrays.Uvs.Length; channel++) { WriteUvs(mesh, channel, arrays.Uvs[channel]); }
        }

        private static void WriteColors(Mesh mesh, MeshArrays arrays)
        {
            if (arrays.HasByteColors) { mesh.colors32 = Array.ConvertAll(arrays.Colors, color => (Color32)color); }
            else { mesh.SetColors(arrays.Colors); }
        }

        private static void WriteUvs(Mesh mesh, int channel, Array values)
        {
            if (values is Vector2[]) { mesh.SetUVs(channel, (Vector2[])values); }
            else if (values is Vector3[]) { mesh.SetUVs(channel, (Vector3[])values); }
            else if (values is Vector4[]) { mesh.SetUVs(channel, (Vector4[])values); }
        }

        private static void WriteSubmeshes(Mesh mesh, SubmeshArrays[] submeshes)
        {
            mesh.subMeshCount = submeshes.Length;
            for (int submesh = 0; submesh < submeshes.Length; submesh++)
            {
                mesh.SetIndices(submeshes[submesh].Indices, submeshes[submesh].Topology, submesh, false);
            }
        }

        private static void WriteSkin(Mesh mesh, Skin skin)
        {
            if (skin.BonesPerVertex.Length > 0)
            {
                using (var counts = new NativeArray<byte>(skin.BonesPerVertex, Allocator.Temp))
                using (var weights = new NativeArray<BoneWeight1>(skin.Weights, Allocator.Temp))
                {
                    mesh.SetBoneWeights(counts, weights);
                }
            }
            mesh.bindposes = skin.Bindposes;
        }

        /// <summary>Bounds may have been widened on purpose, so they never become smaller.</summary>
        private static void WriteBounds(Mesh mesh, Bounds source)
        {
            mesh.RecalculateBounds();
            var bounds = mesh.bounds;
            bounds.Encapsulate(source);
            mesh.bounds = bounds;
        }
    }
}
