using System.Collections.Generic;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Selected places that stand together: those of the scenes, or those of one prefab.</summary>
    internal sealed class SlotGroup
    {
        private readonly Dictionary<Component, GameObject> selected = new Dictionary<Component, GameObject>();

        /// <param name="file">That of the prefab; empty for scenes.</param>
        /// <param name="root">In whose space they stand.</param>
        internal SlotGroup(string file, Transform root)
        {
            File = file;
            Root = root;
        }

        internal string File { get; }

        internal Transform Root { get; }

        internal List<MeshSlot> Slots { get; } = new List<MeshSlot>();

        /// <summary>Those of the places that nobody has chamfered yet; a plan finds them.</summary>
        internal List<MeshSlot> Fresh { get; set; }

        /// <summary>Adds what was found below a selected object.</summary>
        internal void Add(MeshSlot slot, GameObject item)
        {
            Slots.Add(slot);
            selected.Add(slot.Holder, item);
        }

        /// <summary>The selected object that a place was found below.</summary>
        internal GameObject SelectedOf(MeshSlot slot)
        {
            return selected[slot.Holder];
        }
    }
}
