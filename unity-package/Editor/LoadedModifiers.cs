using System.Collections.Generic;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What all modifiers that are loaded know: those of scenes, of prefabs, and of the stage.</summary>
    internal sealed class LoadedModifiers
    {
        /// <summary>An entry of a modifier.</summary>
        internal struct Place
        {
            internal ChamferModifier Modifier;
            internal int Number;

            internal ChamferedMesh Entry => Modifier.meshes[Number];
        }

        private readonly List<Place> places = new List<Place>();
        private readonly Dictionary<Component, Place> byHolder = new Dictionary<Component, Place>();
        private readonly HashSet<Mesh> results = new HashSet<Mesh>();

        internal LoadedModifiers()
        {
            foreach (var modifier in Resources.FindObjectsOfTypeAll<ChamferModifier>())
            {
                for (int i = 0; i < modifier.meshes.Count; i++) { Add(new Place { Modifier = modifier, Number = i }); }
            }
        }

        internal IEnumerable<Place> Places => places;

        /// <summary>Whether a mesh is a result, whoever holds it now.</summary>
        internal bool IsResult(Mesh mesh)
        {
            return results.Contains(mesh);
        }

        /// <summary>Who chamfered what a slot holds now.</summary>
        internal bool TryFind(MeshSlot slot, out Place place)
        {
            return byHolder.TryGetValue(slot.Holder, out place);
        }

        /// <summary>The mesh that a slot held before anybody chamfered it.</summary>
        internal Mesh Original(MeshSlot slot)
        {
            Place place;
            return TryFind(slot, out place) && place.Entry.original != null ? place.Entry.original : slot.Mesh;
        }

        private void Add(Place place)
        {
            var entry = place.Entry;
            places.Add(place);
            if (entry.chamfered != null) { results.Add(entry.chamfered); }
            // A mesh that someone else has put there since is theirs.
            bool isHeld = entry.holder != null && MeshSlot.Of(entry.holder).Mesh == entry.chamfered;
            if (isHeld) { byHolder[entry.holder] = place; }
        }
    }
}
