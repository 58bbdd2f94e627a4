using System.Collections.Generic;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>A place in a hierarchy that holds a mesh.</summary>
    internal struct MeshSlot
    {
        private MeshSlot(Component holder)
        {
            Holder = holder;
        }

        /// <summary>A <c>MeshFilter</c> or <c>SkinnedMeshRenderer</c>.</summary>
        internal Component Holder { get; }

        internal Mesh Mesh
        {
            get
            {
                var filter = Holder as MeshFilter;
                return filter != null ? filter.sharedMesh : ((SkinnedMeshRenderer)Holder).sharedMesh;
            }
            set
            {
                var filter = Holder as MeshFilter;
                if (filter != null) { filter.sharedMesh = value; }
                else { ((SkinnedMeshRenderer)Holder).sharedMesh = value; }
            }
        }

        /// <summary>What draws the mesh, or null.</summary>
        internal Renderer Renderer => Holder.GetComponent<Renderer>();

        internal static MeshSlot Of(Component holder)
        {
            return new MeshSlot(holder);
        }

        /// <summary>All places with a mesh on an object, or also below it; inactive ones too.</summary>
        internal static List<MeshSlot> In(GameObject root, bool children)
        {
            var slots = new List<MeshSlot>();
            foreach (var filter in Find<MeshFilter>(root, children)) { Add(slots, filter); }
            foreach (var skinned in Find<SkinnedMeshRenderer>(root, children)) { Add(slots, skinned); }
            return slots;
        }

        private static T[] Find<T>(GameObject root, bool children) where T : Component
        {
            return children ? root.GetComponentsInChildren<T>(true) : root.GetComponents<T>();
        }

        private static void Add(List<MeshSlot> slots, Component holder)
        {
            var slot = new MeshSlot(holder);
            if (slot.Mesh != null) { slots.Add(slot); }
        }
    }
}
