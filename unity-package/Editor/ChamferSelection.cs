using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// The meshes of selected objects, prefabs and mesh assets, and chamfering them all. Objects of scenes stand
    /// together, and so do those of one prefab.
    /// </summary>
    internal sealed class ChamferSelection
    {
        private const string Action = "Chamfer Selected";

        private sealed class Group
        {
            internal string File;
            internal Transform Root;
            internal readonly List<MeshSlot> Slots = new List<MeshSlot>();
        }

        private readonly List<MeshSlot> slots = new List<MeshSlot>();
        private readonly List<Group> groups = new List<Group>();
        private readonly List<Mesh> assets = new List<Mesh>();

        internal ChamferSelection(IEnumerable<Object> selected)
        {
            var holders = new HashSet<Component>();
            foreach (var item in selected)
            {
                if (item is Mesh) { assets.Add((Mesh)item); }
                if (item is GameObject) { AddHierarchy((GameObject)item, holders); }
            }
        }

        internal bool IsEmpty => slots.Count == 0 && assets.Count == 0;

        /// <summary>Chamfers all in one undo step; null if the user cancelled.</summary>
        internal JobSummary Chamfer(ChamferSettings settings)
        {
            var summary = new JobSummary();
            return Chamfer(settings, summary) ? summary : null;
        }

        /// <summary>Chamfers all in one undo step, and adds to a summary; false if the user cancelled.</summary>
        internal bool Chamfer(ChamferSettings settings, JobSummary summary)
        {
            var scenes = groups.ConvertAll(one => MeshScene.Of(one.Root, one.Slots));
            scenes.AddRange(assets.ConvertAll(mesh => MeshScene.Of(mesh)));
            var job = new ChamferJob();
            if (!job.Run(scenes, settings)) { return false; }
            int group = BeginUndo();
            // What is in a file can be used by all others; what is in a scene, by that scene only.
            SaveAssets(job);
            ReplaceSlots(job, slots.Where(slot => SlotEditing.IsInPrefab(slot.Holder)));
            ReplaceSlots(job, slots.Where(slot => !SlotEditing.IsInPrefab(slot.Holder)));
            Undo.CollapseUndoOperations(group);
            AssetDatabase.SaveAssets();
            summary.Add(job);
            return true;
        }

        private void AddHierarchy(GameObject root, HashSet<Component> holders)
        {
            foreach (var slot in MeshSlot.In(root, true))
            {
                if (SlotEditing.IsLocked(slot.Holder) || !holders.Add(slot.Holder)) { continue; }
                slots.Add(slot);
                GroupOf(root).Slots.Add(slot);
            }
        }

        private Group GroupOf(GameObject root)
        {
            string file = AssetDatabase.GetAssetPath(root);
            var group = groups.Find(other => other.File == file);
            if (group == null) { groups.Add(group = new Group { File = file, Root = root.transform }); }
            return group;
        }

        private static int BeginUndo()
        {
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName(Action);
            return Undo.GetCurrentGroup();
        }

        private static void ReplaceSlots(ChamferJob job, IEnumerable<MeshSlot> slots)
        {
            foreach (var slot in slots)
            {
                JobResult result;
                if (!TryFind(job, slot.Mesh, out result)) { continue; }
                if (result.Mesh == null) { SlotEditing.Write(result, slot.Holder, null, Action); }
                MaterialSlots.Fill(slot, slot.Mesh, result.Mesh, Action);
                SlotEditing.Set(slot, result.Mesh, Action);
            }
        }

        /// <summary>Meshes selected by themselves are not replaced: the new ones are saved beside them.</summary>
        private void SaveAssets(ChamferJob job)
        {
            foreach (var mesh in assets)
            {
                JobResult result;
                string path = AssetDatabase.GetAssetPath(mesh);
                bool isNew = TryFind(job, mesh, out result) && result.Mesh == null;
                if (isNew && path.Length > 0) { SaveBeside(path, result); }
            }
        }

        /// <summary>The file of an earlier time is written anew, so that what uses it follows.</summary>
        private static void SaveBeside(string path, JobResult result)
        {
            path = path.Substring(0, path.LastIndexOf('/') + 1) + result.Name + ".asset";
            var earlier = AssetDatabase.LoadAssetAtPath<Mesh>(path);
            if (earlier != null)
            {
                Undo.RegisterCompleteObjectUndo(earlier, Action);
                result.Write(earlier);
                EditorUtility.SetDirty(earlier);
                return;
            }
            result.Write();
            AssetDatabase.CreateAsset(result.Mesh, AssetDatabase.GenerateUniqueAssetPath(path));
        }

        /// <summary>Meshes of which no edge can be chamfered, or none more, are left alone.</summary>
        private static bool TryFind(ChamferJob job, Mesh mesh, out JobResult result)
        {
            return job.Results.TryGetValue(mesh, out result) && result.Report.Chamfered + result.Report.Narrowed > 0;
        }
    }
}
