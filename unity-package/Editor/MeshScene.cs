using System;
using System.Collections.Generic;
using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Meshes that stand together, so that none loses what another rests on.</summary>
    internal sealed class MeshScene
    {
        private string surroundings;

        private MeshScene(string name, List<PlacedMesh> objects)
        {
            Name = name;
            Objects = objects;
            Wanted = new HashSet<Mesh>(objects.ConvertAll(one => one.Mesh));
        }

        /// <summary>For the progress bar.</summary>
        internal string Name { get; }

        internal IReadOnlyList<PlacedMesh> Objects { get; }

        /// <summary>The meshes to chamfer; the others only stand around.</summary>
        internal HashSet<Mesh> Wanted { get; private set; }

        /// <summary>What stands below a root, or beside it.</summary>
        internal static MeshScene Of(Transform root, IEnumerable<MeshSlot> slots)
        {
            return Of(root, slots, slot => slot.Mesh);
        }

        /// <summary>As <see cref="Of(Transform, IEnumerable{MeshSlot})"/>, with other meshes in the slots.</summary>
        internal static MeshScene Of(Transform root, IEnumerable<MeshSlot> slots, Func<MeshSlot, Mesh> meshOf)
        {
            var objects = new List<PlacedMesh>();
            foreach (var slot in slots) { objects.Add(ObjectOf(root, slot, meshOf(slot))); }
            return new MeshScene(root.name, objects);
        }

        private static PlacedMesh ObjectOf(Transform root, MeshSlot slot, Mesh mesh)
        {
            var renderer = slot.Renderer;
            return new PlacedMesh(mesh, Place(root, slot.Holder))
            {
                WorldScale = slot.Holder.transform.lossyScale,
                Materials = renderer != null ? renderer.sharedMaterials : null
            };
        }

        /// <summary>A mesh that stands nowhere.</summary>
        internal static MeshScene Of(Mesh mesh)
        {
            return new MeshScene(mesh.name, new List<PlacedMesh> { new PlacedMesh(mesh, Matrix4x4.identity) });
        }

        /// <summary>The source of a file, which stands nowhere any more, but is measured as it was.</summary>
        internal static MeshScene Of(ChamferRecord record)
        {
            var one = new PlacedMesh(record.source, Matrix4x4.identity) { MaterialNames = record.materials };
            if (record.worldScale.magnitude > 0) { one.WorldScale = record.worldScale; }
            return new MeshScene(record.source.name, new List<PlacedMesh> { one });
        }

        /// <summary>The same scene, of which only some meshes are chamfered.</summary>
        internal MeshScene Wanting(IEnumerable<Mesh> meshes)
        {
            Wanted = new HashSet<Mesh>(meshes);
            return this;
        }

        /// <summary>
        /// Tells a mesh, how it is chamfered and what stands around it: where keys are equal, results are. Unknown
        /// where a mesh cannot be read.
        /// </summary>
        internal string KeyOf(Mesh mesh, ChamferSettings settings)
        {
            if (surroundings == null) { surroundings = Surroundings(); }
            var parts = new List<string> { MeshKeys.Of(mesh), SettingsText.Of(settings), surroundings };
            foreach (var one in Objects) { AddMeasures(parts, one, settings.edges); }
            return MeshKeys.Join(parts.ToArray());
        }

        /// <summary>Adds what the settings take from an object: nothing, unless they ask for it.</summary>
        private static void AddMeasures(List<string> parts, PlacedMesh one, EdgeSettings edges)
        {
            if (edges.worldWidth)
            {
                var scale = one.WorldScale;
                foreach (float axis in new[] { scale.x, scale.y, scale.z }) { parts.Add(SettingsText.Number(axis)); }
            }
            if (!edges.HasMaterials) { return; }
            var names = one.MaterialNames ?? SceneArrays.NamesOf(one.Materials) ?? new string[0];
            parts.Add(names.Length.ToString());
            foreach (string name in names) { parts.Add(SettingsText.Number(edges.FactorOf(name))); }
        }

        /// <summary>A mesh that stands alone is the same wherever it stands.</summary>
        private string Surroundings()
        {
            if (Objects.Count == 1) { return "alone"; }
            var parts = new List<string>();
            foreach (var one in Objects)
            {
                parts.Add(MeshKeys.Of(one.Mesh));
                for (int i = 0; i < 16; i++) { parts.Add(SettingsText.Number(one.Transform[i])); }
            }
            return MeshKeys.Join(parts.ToArray());
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
