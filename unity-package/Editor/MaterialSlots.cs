using System;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Materials for chamfers with a submesh of their own: Unity does not draw a submesh without one.</summary>
    internal static class MaterialSlots
    {
        /// <summary>Repeats the last material until every submesh of the mesh has one; returns how often.</summary>
        internal static int Fill(MeshSlot slot, Mesh before, Mesh after, string action)
        {
            var renderer = slot.Renderer;
            int added = after.subMeshCount - before.subMeshCount;
            if (renderer == null || added <= 0) { return 0; }
            var materials = renderer.sharedMaterials;
            // Who draws only some submeshes on purpose, or some of them twice, keeps it so.
            if (materials.Length != before.subMeshCount || materials.Length == 0) { return 0; }
            Undo.RecordObject(renderer, action);
            renderer.sharedMaterials = Resized(materials, materials.Length + added);
            SlotEditing.Changed(renderer);
            return added;
        }

        /// <summary>Takes back what <see cref="Fill"/> did.</summary>
        internal static void Drop(MeshSlot slot, int added, string action)
        {
            var renderer = slot.Renderer;
            if (renderer == null || added == 0 || renderer.sharedMaterials.Length <= added) { return; }
            Undo.RecordObject(renderer, action);
            renderer.sharedMaterials = Resized(renderer.sharedMaterials, renderer.sharedMaterials.Length - added);
            SlotEditing.Changed(renderer);
        }

        private static Material[] Resized(Material[] materials, int count)
        {
            var resized = new Material[count];
            for (int i = 0; i < count; i++) { resized[i] = materials[Math.Min(i, materials.Length - 1)]; }
            return resized;
        }
    }
}
