using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Puts the results of a selection into its objects, each remembered by a modifier.</summary>
    internal sealed class SlotReplacement
    {
        private readonly SelectionPlan plan;
        private readonly ChamferJob job;
        private readonly SelectionStep step;

        internal SlotReplacement(SelectionPlan plan, ChamferJob job, SelectionStep step)
        {
            this.plan = plan;
            this.job = job;
            this.step = step;
        }

        internal void Run()
        {
            // What is in a file can be used by all others; what is in a scene, by that scene only.
            foreach (var group in plan.Fresh.OrderBy(IsOfScene))
            {
                foreach (var slot in group.Fresh) { Replace(group, slot); }
                step.Touch(group.File);
            }
        }

        private static bool IsOfScene(SlotGroup group)
        {
            return group.Fresh.Any(slot => !SlotEditing.IsInPrefab(slot.Holder));
        }

        /// <summary>Meshes of which no edge can be chamfered are left alone.</summary>
        private void Replace(SlotGroup group, MeshSlot slot)
        {
            JobResult result;
            if (!job.Results.TryGetValue(slot.Mesh, out result) || !result.HasChanged) { return; }
            if (result.Mesh == null) { result = Shared(result, slot) ?? result; }
            if (result.Mesh == null) { Write(result, slot); }
            var modifier = ModifierFor(group, slot, result.Settings);
            var placed = MeshScene.Place(modifier.transform, slot.Holder);
            ModifierActions.Put(modifier, slot, result, placed, step.Action);
        }

        private JobResult Shared(JobResult result, MeshSlot slot)
        {
            return SharedMeshes.Find(plan.Loaded, result.Source, result.Key, slot.Holder, null);
        }

        private void Write(JobResult result, MeshSlot slot)
        {
            var files = Users(result.Source).Select(user => SlotEditing.FilePath(user.Holder)).Where(path => path.Length > 0);
            var prefabs = files.Distinct().OrderBy(path => path, System.StringComparer.Ordinal).ToList();
            if (prefabs.Count > 1) { step.CreateShared(result, prefabs[0]); }
            else { SlotEditing.Write(result, slot.Holder, null, step.Action); }
        }

        private IEnumerable<MeshSlot> Users(Mesh mesh)
        {
            return plan.Fresh.SelectMany(group => group.Fresh).Where(slot => slot.Mesh == mesh);
        }

        /// <summary>The modifier that remembers a slot: one on the selected object, unless that has one of its own.</summary>
        private ChamferModifier ModifierFor(SlotGroup group, MeshSlot slot, ChamferSettings settings)
        {
            var known = ModifierSlots.Owner(slot.Holder);
            if (known != null) { return known; }
            var root = group.SelectedOf(slot);
            bool isTaken = root.GetComponent<ChamferModifier>() != null;
            var modifier = Undo.AddComponent<ChamferModifier>(isTaken ? slot.Holder.gameObject : root);
            modifier.isFromMenu = true;
            modifier.settings = settings.Copy();
            modifier.includeChildren = !isTaken && group.Slots.Any(other => IsBelow(group, other, root));
            modifier.LeaveOutOfBuilds();
            SlotEditing.Changed(modifier);
            return modifier;
        }

        private static bool IsBelow(SlotGroup group, MeshSlot slot, GameObject root)
        {
            return group.SelectedOf(slot) == root && slot.Holder.gameObject != root;
        }
    }
}
