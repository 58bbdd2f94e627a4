using System.Collections.Generic;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Which meshes a modifier chamfers.</summary>
    internal static class ModifierSlots
    {
        /// <summary>Those of its object and, if it includes children, below, but for those of modifiers below.</summary>
        internal static List<MeshSlot> Of(ChamferModifier modifier)
        {
            var slots = MeshSlot.In(modifier.gameObject, modifier.includeChildren);
            slots.RemoveAll(slot => Owner(slot.Holder) != modifier || SlotEditing.IsLocked(slot.Holder));
            slots.RemoveAll(slot => ModifierLods.IsFar(slot.Holder));
            return slots;
        }

        /// <summary>The nearest modifier that chamfers what an object holds; null if none does.</summary>
        internal static ChamferModifier Owner(Component holder)
        {
            foreach (var modifier in holder.GetComponentsInParent<ChamferModifier>(true))
            {
                if (modifier.includeChildren || modifier.gameObject == holder.gameObject) { return modifier; }
            }
            return null;
        }
    }
}
