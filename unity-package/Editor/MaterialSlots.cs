using System;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Materials for chamfers with a submesh of their own: Unity does not draw a submesh without one.</summary>
    internal static class MaterialSlots
    {
        /// <summary>Repeats the last material for submeshes that a mesh gained; returns how often.</summary>
        internal static int Fill(MeshSlot slot, Mesh before, Mesh after, string action)
        {
            int gained = after.subMeshCount - before.subMeshCount;
            if (!CanFill(slot.Renderer, before.subMeshCount, gained)) { return 0; }
            Undo.RecordObject(slot.Renderer, action);
            Resize(slot.Renderer, gained);
            SlotEditing.Changed(slot.Renderer);
            return gained;
        }

        /// <summary>As <see cref="Fill"/>, in a model that is being imported, where nothing can be undone.</summary>
        internal static void FillImported(MeshSlot slot, int before, int gained)
        {
            if (CanFill(slot.Renderer, before, gained)) { Resize(slot.Renderer, gained); }
        }

        /// <summary>Takes back what <see cref="Fill"/> did.</summary>
        internal static void Drop(MeshSlot slot, int added, string action)
        {
            var renderer = slot.Renderer;
            if (renderer == null || added == 0 || renderer.sharedMaterials.Length <= added) { return; }
            Undo.RecordObject(renderer, action);
            Resize(renderer, -added);
            SlotEditing.Changed(renderer);
        }

        /// <summary>Who draws only some submeshes on purpose, or some of them twice, keeps it so.</summary>
        private static bool CanFill(Renderer renderer, int before, int gained)
        {
            return renderer != null && gained > 0 && before > 0 && renderer.sharedMaterials.Length == before;
        }

        private static void Resize(Renderer renderer, int change)
        {
            var materials = renderer.sharedMaterials;
            var resized = new Material[materials.Length + change];
            for (int i = 0; i < resized.Length; i++) { resized[i] = materials[Math.Min(i, materials.Length - 1)]; }
            renderer.sharedMaterials = resized;
        }
    }
}
