using System;
using System.Collections.Generic;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Meshes that stand together, so that none loses what another rests on.</summary>
    internal sealed class MeshScene
    {
        private MeshScene(string name, List<PlacedMesh> objects)
        {
            Name = name;
            Objects = objects;
        }

        /// <summary>For the progress bar.</summary>
        internal string Name { get; }

        internal IReadOnlyList<PlacedMesh> Objects { get; }

        /// <summary>What stands below a root, or beside it.</summary>
        internal static MeshScene Of(Transform root, IEnumerable<MeshSlot> slots)
        {
            return Of(root, slots, slot => slot.Mesh);
        }

        /// <summary>As <see cref="Of(Transform, IEnumerable{MeshSlot})"/>, with other meshes in the slots.</summary>
        internal static MeshScene Of(Transform root, IEnumerable<MeshSlot> slots, Func<MeshSlot, Mesh> meshOf)
        {
            var objects = new List<PlacedMesh>();
            foreach (var slot in slots) { objects.Add(new PlacedMesh(meshOf(slot), Place(root, slot.Holder))); }
            return new MeshScene(root.name, objects);
        }

        /// <summary>A mesh that stands nowhere.</summary>
        internal static MeshScene Of(Mesh mesh)
        {
            return new MeshScene(mesh.name, new List<PlacedMesh> { new PlacedMesh(mesh, Matrix4x4.identity) });
        }

        /// <summary>
        /// From a mesh to the space of the root. What is below the root is placed without going by the world: far
        /// from its origin, positions are too coarse to tell what touches.
        /// </summary>
        internal static Matrix4x4 Place(Transform root, Component holder)
        {
            var place = Matrix4x4.identity;
            var above = holder.transform;
            for (; above != null && above != root; above = above.parent)
            {
                place = Matrix4x4.TRS(above.localPosition, above.localRotation, above.localScale) * place;
            }
            if (above == null) { place = root.worldToLocalMatrix * holder.transform.localToWorldMatrix; }
            // Where the root is scaled to nothing there may be no way to its space.
            return IsFinite(place) ? place : Matrix4x4.zero;
        }

        private static bool IsFinite(Matrix4x4 matrix)
        {
            for (int i = 0; i < 16; i++)
            {
                if (float.IsNaN(matrix[i]) || float.IsInfinity(matrix[i])) { return false; }
            }
            return true;
        }
    }
}
