using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// What is to be done with a selection. What is chamfered already is known from what was written down then, not
    /// guessed from edges: those that were left hard would be found again.
    /// </summary>
    internal sealed class SelectionPlan
    {
        private readonly LoadedModifiers loaded = new LoadedModifiers();
        private readonly List<SlotGroup> fresh;
        private readonly HashSet<Mesh> already = new HashSet<Mesh>();
        private readonly List<ChamferModifier> outdated = new List<ChamferModifier>();

        internal SelectionPlan(IEnumerable<SlotGroup> groups, IEnumerable<Mesh> assets)
        {
            fresh = groups.ToList();
            foreach (var group in fresh) { group.Fresh = group.Slots.FindAll(IsFresh); }
            fresh.RemoveAll(group => group.Fresh.Count == 0);
            Assets = assets.Where(mesh => !IsResult(mesh)).ToList();
            Scenes = fresh.Select(SceneOf).Concat(Assets.Select(mesh => MeshScene.Of(mesh))).ToList();
        }

        /// <summary>What nobody has chamfered yet, group by group.</summary>
        internal IReadOnlyList<SlotGroup> Fresh => fresh;

        /// <summary>Meshes that are no results themselves.</summary>
        internal IReadOnlyList<Mesh> Assets { get; }

        /// <summary>What to chamfer, as it stands together.</summary>
        internal IReadOnlyList<MeshScene> Scenes { get; }

        /// <summary>Modifiers that have more to chamfer, or whose sources have changed.</summary>
        internal IReadOnlyList<ChamferModifier> Outdated => outdated;

        /// <summary>How many meshes are as they should be.</summary>
        internal int Already => already.Count;

        internal LoadedModifiers Loaded => loaded;

        /// <summary>Whether nobody has chamfered what a slot holds; notes what is to be done otherwise.</summary>
        private bool IsFresh(MeshSlot slot)
        {
            LoadedModifiers.Place place;
            if (loaded.TryFind(slot, out place))
            {
                if (ModifierState.IsOutdated(place.Modifier, place.Entry)) { AddOutdated(place.Modifier); }
                else { already.Add(slot.Mesh); }
                return false;
            }
            if (IsResult(slot.Mesh)) { return false; }
            var owner = ModifierSlots.Owner(slot.Holder);
            if (owner != null) { AddOutdated(owner); }
            return owner == null;
        }

        private bool IsResult(Mesh mesh)
        {
            bool isResult = loaded.IsResult(mesh) || ChamferRecords.IsResult(mesh);
            if (isResult) { already.Add(mesh); }
            return isResult;
        }

        private void AddOutdated(ChamferModifier modifier)
        {
            if (!outdated.Contains(modifier)) { outdated.Add(modifier); }
        }

        /// <summary>With all that stands around, also what is chamfered already.</summary>
        private static MeshScene SceneOf(SlotGroup group)
        {
            return MeshScene.Of(group.Root, group.Slots).Wanting(group.Fresh.ConvertAll(slot => slot.Mesh));
        }
    }
}
