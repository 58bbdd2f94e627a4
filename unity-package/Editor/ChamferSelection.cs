using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>
    /// The meshes of selected objects, prefabs and mesh assets, and chamfering them all. Objects of scenes stand
    /// together, and so do those of one prefab.
    /// </summary>
    internal sealed class ChamferSelection
    {
        private const string Action = "Chamfer Selected";

        private readonly List<SlotGroup> groups = new List<SlotGroup>();
        private readonly List<Mesh> assets = new List<Mesh>();
        private readonly HashSet<Component> holders = new HashSet<Component>();
        private readonly SortedSet<string> reasons = new SortedSet<string>(StringComparer.Ordinal);

        internal ChamferSelection(IEnumerable<Object> selected)
        {
            foreach (var item in selected)
            {
                if (item is Mesh) { assets.Add((Mesh)item); }
                if (item is GameObject) { AddHierarchy((GameObject)item); }
            }
            // They have what their prefab has.
            foreach (var group in groups) { group.Slots.RemoveAll(IsFollower); }
            groups.RemoveAll(group => group.Slots.Count == 0);
        }

        internal bool IsEmpty => groups.Count == 0 && assets.Count == 0;

        /// <summary>Why some of what is selected cannot be chamfered, and what to do.</summary>
        internal IEnumerable<string> Reasons => reasons;

        /// <summary>Chamfers all in one undo step; null if the user cancelled.</summary>
        internal JobSummary Chamfer(ChamferSettings settings)
        {
            var summary = new JobSummary();
            return Chamfer(settings, summary) ? summary : null;
        }

        /// <summary>
        /// Chamfers all in one undo step, and adds to a summary; false if the user cancelled. Whatever goes wrong,
        /// either all is done or all is as before.
        /// </summary>
        internal bool Chamfer(ChamferSettings settings, JobSummary summary)
        {
            var plan = new SelectionPlan(groups, assets);
            var job = new ChamferJob();
            if (!job.Run(plan.Scenes, settings)) { return false; }
            using (var step = new SelectionStep(Action))
            {
                if (!Redo(plan, summary)) { return false; }
                var earlier = new EarlierResults();
                foreach (var mesh in plan.Assets) { SaveBeside(mesh, earlier.Of(mesh), job, step); }
                new SlotReplacement(plan, job, step).Run();
                step.Finish();
            }
            summary.Add(job);
            summary.AddAlready(plan.Already);
            return true;
        }

        /// <summary>Modifiers chamfer what is theirs, with their own settings.</summary>
        private static bool Redo(SelectionPlan plan, JobSummary summary)
        {
            foreach (var modifier in plan.Outdated)
            {
                var run = new ModifierRun(modifier, modifier.Effective);
                if (!run.TryChamfer()) { return false; }
                summary.Add(run);
            }
            return true;
        }

        private void AddHierarchy(GameObject root)
        {
            foreach (var slot in MeshSlot.In(root, true).Where(slot => !ModifierLods.IsFar(slot.Holder)))
            {
                string why = SlotEditing.WhyLocked(slot.Holder);
                if (why != null) { reasons.Add(why); }
                else if (holders.Add(slot.Holder)) { GroupOf(root).Add(slot, root); }
            }
        }

        private SlotGroup GroupOf(GameObject root)
        {
            string file = AssetDatabase.GetAssetPath(root);
            var group = groups.Find(other => other.File == file);
            if (group == null) { groups.Add(group = new SlotGroup(file, root.transform)); }
            return group;
        }

        /// <summary>Whether a slot has the mesh of a prefab that is processed, too: a variant's, or an instance's.</summary>
        private bool IsFollower(MeshSlot slot)
        {
            var source = PrefabUtility.GetCorrespondingObjectFromSource(slot.Holder);
            for (; source != null; source = PrefabUtility.GetCorrespondingObjectFromSource(source))
            {
                if (MeshSlot.Of(source).Mesh != slot.Mesh) { return false; }
                if (holders.Contains(source)) { return true; }
            }
            return false;
        }

        /// <summary>
        /// Meshes selected by themselves are not replaced: the new ones are saved beside them. The file of an earlier
        /// time is written anew, so that what uses it follows.
        /// </summary>
        private static void SaveBeside(Mesh mesh, Mesh earlier, ChamferJob job, SelectionStep step)
        {
            JobResult result;
            string path = AssetDatabase.GetAssetPath(mesh);
            bool isNew = job.Results.TryGetValue(mesh, out result) && result.HasChanged && result.Mesh == null;
            if (!isNew || path.Length == 0) { return; }
            if (earlier == null) { step.Create(result, AssetNames.Free(AssetNames.FolderBeside(mesh), mesh)); }
            else if (!EarlierResults.IsCurrent(earlier, result)) { step.Rewrite(result, earlier); }
        }
    }
}
