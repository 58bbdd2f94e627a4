using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What the buttons of the modifier's inspector do.</summary>
    internal static class ModifierActions
    {
        private const string RevertName = "Revert Chamfer";

        /// <summary>Chamfers the originals with the modifier's settings; returns what went wrong.</summary>
        internal static IReadOnlyList<string> Chamfer(ChamferModifier modifier)
        {
            string why = SlotEditing.WhyLocked(modifier);
            if (why != null) { return new[] { why }; }
            var run = new ModifierRun(modifier, modifier.Effective);
            run.TryChamfer();
            return run.Failures;
        }

        /// <summary>As <see cref="Chamfer"/>, but in time for a slider that is dragged.</summary>
        internal static IReadOnlyList<string> Preview(ChamferModifier modifier)
        {
            string why = SlotEditing.WhyLocked(modifier);
            if (why != null) { return new[] { why }; }
            var run = new PreviewRun(modifier);
            run.Work();
            run.Finish();
            return run.Failures;
        }

        /// <summary>Puts the original meshes back.</summary>
        internal static void Revert(ChamferModifier modifier)
        {
            if (SlotEditing.IsLocked(modifier)) { return; }
            PreviewQueue.Cancel(modifier);
            var former = modifier.meshes.ToArray();
            ModifierLods.Drop(modifier);
            Restore(modifier, RevertName);
            SlotEditing.Changed(modifier);
            DropUnused(former);
        }

        /// <summary>Saves the chamfered meshes as files in a folder of the project; returns their paths.</summary>
        internal static List<string> Save(ChamferModifier modifier, string folder)
        {
            var paths = new List<string>();
            foreach (var entry in modifier.meshes)
            {
                if (entry.chamfered == null || AssetDatabase.Contains(entry.chamfered)) { continue; }
                string path = AssetNames.Free(folder, entry.original != null ? entry.original : entry.chamfered);
                AssetDatabase.CreateAsset(entry.chamfered, path);
                // Undo would destroy the mesh, but not the file.
                Undo.ClearUndo(entry.chamfered);
                ChamferRecords.Write(entry.chamfered, ChamferRecord.Make(entry));
                AssetDatabase.SaveAssetIfDirty(entry.chamfered);
                paths.Add(path);
            }
            return paths;
        }

        /// <summary>A folder on disk as assets are named, from Assets on; null if it is not in there.</summary>
        internal static string ProjectFolder(string folder, string assets)
        {
            bool isInside = (folder + "/").StartsWith(assets + "/", StringComparison.Ordinal);
            return isInside ? "Assets" + folder.Substring(assets.Length) : null;
        }

        /// <summary>Puts a result into a slot, and remembers what it replaced.</summary>
        internal static void Put(ChamferModifier modifier, MeshSlot slot, JobResult result, Matrix4x4 placed, string action)
        {
            Undo.RecordObject(modifier, action);
            SlotEditing.Set(slot, result.Mesh, action);
            modifier.meshes.Add(new ChamferedMesh
            {
                holder = slot.Holder,
                original = result.Source,
                chamfered = result.Mesh,
                settings = result.Settings,
                key = result.Key,
                sourceKey = MeshKeys.Of(result.Source),
                report = result.Text,
                placed = placed,
                worldScale = slot.Holder.transform.lossyScale,
                addedMaterials = MaterialSlots.Fill(slot, result.Source, result.Mesh, action)
            });
            SlotEditing.Changed(modifier);
        }

        /// <summary>Puts back what the entries of a modifier replaced, and forgets them.</summary>
        internal static void Restore(ChamferModifier modifier, string action)
        {
            Undo.RecordObject(modifier, action);
            foreach (var entry in modifier.meshes) { Restore(entry, action); }
            modifier.meshes.Clear();
        }

        /// <summary>Puts back what a modifier replaced in one object, because another modifier has that now.</summary>
        internal static void Restore(ChamferModifier modifier, Component holder, string action)
        {
            Undo.RecordObject(modifier, action);
            int number = modifier.meshes.FindIndex(entry => entry.holder == holder);
            Restore(modifier.meshes[number], action);
            modifier.meshes.RemoveAt(number);
            SlotEditing.Changed(modifier);
        }

        /// <summary>Takes away the meshes of former entries that nobody uses any more.</summary>
        internal static void DropUnused(IEnumerable<ChamferedMesh> former)
        {
            var known = former.Where(entry => entry.chamfered != null && entry.holder != null);
            foreach (var same in known.GroupBy(entry => entry.chamfered))
            {
                var holders = new HashSet<Component>(same.Select(entry => entry.holder));
                bool isHeld = holders.Any(holder => MeshSlot.Of(holder).Mesh == same.Key);
                if (!isHeld && !MeshUsers.HasOthers(same.Key, holders)) { SlotEditing.Drop(same.Key, holders.First()); }
            }
        }

        private static void Restore(ChamferedMesh entry, string action)
        {
            if (entry.holder == null || entry.original == null) { return; }
            var slot = MeshSlot.Of(entry.holder);
            // A mesh that someone else has put there since is theirs.
            if (slot.Mesh != entry.chamfered) { return; }
            SlotEditing.Set(slot, entry.original, action);
            MaterialSlots.Drop(slot, entry.addedMaterials, action);
        }
    }
}
