using System.Collections.Generic;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The meshes of selected objects, prefabs and mesh assets, and chamfering them all.</summary>
    internal sealed class ChamferSelection
    {
        private const string Action = "Chamfer Selected";

        private readonly List<MeshSlot> slots = new List<MeshSlot>();
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

        /// <summary>Whether some mesh could not be chamfered.</summary>
        internal bool HasFailed { get; private set; }

        internal bool IsEmpty => slots.Count == 0 && assets.Count == 0;

        /// <summary>Chamfers all in one undo step; returns a summary, or null if the user cancelled.</summary>
        internal string Chamfer(ChamferSettings settings)
        {
            var meshes = slots.ConvertAll(slot => slot.Mesh);
            meshes.AddRange(assets);
            var job = new ChamferJob();
            if (!job.Run(meshes, settings)) { return null; }
            HasFailed = job.Failures.Count > 0;
            int group = BeginUndo();
            ReplaceSlots(job);
            SaveAssets(job);
            Undo.CollapseUndoOperations(group);
            AssetDatabase.SaveAssets();
            return job.Summary();
        }

        private void AddHierarchy(GameObject root, HashSet<Component> holders)
        {
            foreach (var slot in MeshSlot.In(root, true))
            {
                if (!SlotEditing.IsImported(slot.Holder) && holders.Add(slot.Holder)) { slots.Add(slot); }
            }
        }

        private static int BeginUndo()
        {
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName(Action);
            return Undo.GetCurrentGroup();
        }

        private void ReplaceSlots(ChamferJob job)
        {
            var kept = new HashSet<Mesh>();
            foreach (var slot in slots)
            {
                ChamferResult result;
                if (!job.Results.TryGetValue(slot.Mesh, out result)) { continue; }
                if (kept.Add(result.Mesh)) { SlotEditing.Keep(result.Mesh, slot.Holder, Action); }
                SlotEditing.Set(slot, result.Mesh, Action);
            }
        }

        /// <summary>Meshes selected by themselves are not replaced: the new ones are saved beside them.</summary>
        private void SaveAssets(ChamferJob job)
        {
            foreach (var mesh in assets)
            {
                ChamferResult result;
                bool isNew = job.Results.TryGetValue(mesh, out result) && !AssetDatabase.Contains(result.Mesh);
                if (!isNew) { continue; }
                string path = AssetDatabase.GetAssetPath(mesh);
                string folder = path.Substring(0, path.LastIndexOf('/') + 1);
                path = AssetDatabase.GenerateUniqueAssetPath(folder + result.Mesh.name + ".asset");
                AssetDatabase.CreateAsset(result.Mesh, path);
            }
        }
    }
}
