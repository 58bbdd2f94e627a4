using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What the buttons of the modifier's inspector do.</summary>
    internal static class ModifierActions
    {
        private const string ChamferName = "Chamfer";
        private const string RevertName = "Revert Chamfer";

        /// <summary>Milliseconds that a preview may take before it shows progress.</summary>
        private const double Patience = 500;

        /// <summary>Chamfers the originals with the modifier's settings; returns what went wrong.</summary>
        internal static IReadOnlyList<string> Chamfer(ChamferModifier modifier)
        {
            return Chamfer(modifier, modifier.settings);
        }

        /// <summary>As <see cref="Chamfer(ChamferModifier)"/>, but in time for a slider that is dragged.</summary>
        internal static IReadOnlyList<string> Preview(ChamferModifier modifier)
        {
            var settings = modifier.settings;
            if (settings.verify == VerifyMode.Seen) { settings.verify = VerifyMode.Full; }
            return Chamfer(modifier, settings);
        }

        private static IReadOnlyList<string> Chamfer(ChamferModifier modifier, ChamferSettings settings)
        {
            var slots = MeshSlot.In(modifier.gameObject, modifier.includeChildren);
            slots.RemoveAll(slot => SlotEditing.IsLocked(slot.Holder));
            var originals = slots.ConvertAll(slot => Original(modifier, slot));
            var job = new ChamferJob(Patience);
            var scene = MeshScene.Of(modifier.transform, slots, slot => Original(modifier, slot));
            if (!job.Run(new[] { scene }, settings)) { return new string[0]; }
            // Results of the last time are no originals of the next, also where children are left out now.
            var former = modifier.meshes.ToArray();
            Restore(modifier, ChamferName);
            Apply(modifier, settings, slots, originals, job, former);
            DropUnused(modifier, former);
            return job.Failures;
        }

        /// <summary>Puts the original meshes back.</summary>
        internal static void Revert(ChamferModifier modifier)
        {
            var former = modifier.meshes.ToArray();
            Restore(modifier, RevertName);
            SlotEditing.Changed(modifier);
            DropUnused(modifier, former);
        }

        /// <summary>Saves the chamfered meshes as files in a folder of the project; returns their paths.</summary>
        internal static List<string> Save(ChamferModifier modifier, string folder)
        {
            var paths = new List<string>();
            foreach (var entry in modifier.meshes)
            {
                if (entry.chamfered == null || AssetDatabase.Contains(entry.chamfered)) { continue; }
                string path = AssetDatabase.GenerateUniqueAssetPath(folder + "/" + FileName(entry.chamfered) + ".asset");
                AssetDatabase.CreateAsset(entry.chamfered, path);
                paths.Add(path);
            }
            AssetDatabase.SaveAssets();
            return paths;
        }

        /// <summary>A folder on disk as assets are named, from Assets on; null if it is not in there.</summary>
        internal static string ProjectFolder(string folder, string assets)
        {
            bool isInside = (folder + "/").StartsWith(assets + "/", StringComparison.Ordinal);
            return isInside ? "Assets" + folder.Substring(assets.Length) : null;
        }

        /// <summary>The mesh that a slot held before this modifier.</summary>
        private static Mesh Original(ChamferModifier modifier, MeshSlot slot)
        {
            var current = slot.Mesh;
            int known = modifier.meshes.FindIndex(entry => entry.holder == slot.Holder);
            bool isOurs = known >= 0 && modifier.meshes[known].chamfered == current;
            return isOurs && modifier.meshes[known].original != null ? modifier.meshes[known].original : current;
        }

        private static void Restore(ChamferModifier modifier, string action)
        {
            Undo.RecordObject(modifier, action);
            foreach (var entry in modifier.meshes)
            {
                if (entry.holder == null || entry.original == null) { continue; }
                var slot = MeshSlot.Of(entry.holder);
                // A mesh that someone else has put there since is theirs.
                if (slot.Mesh != entry.chamfered) { continue; }
                SlotEditing.Set(slot, entry.original, action);
                MaterialSlots.Drop(slot, entry.addedMaterials, action);
            }
            modifier.meshes.Clear();
        }

        private static void Apply(
            ChamferModifier modifier,
            ChamferSettings settings,
            List<MeshSlot> slots,
            List<Mesh> originals,
            ChamferJob job,
            ChamferedMesh[] former)
        {
            for (int i = 0; i < slots.Count; i++)
            {
                JobResult result;
                if (!job.Results.TryGetValue(originals[i], out result)) { continue; }
                if (result.Mesh == null) { Write(result, slots[i], originals[i], former); }
                SlotEditing.Set(slots[i], result.Mesh, ChamferName);
                modifier.meshes.Add(new ChamferedMesh
                {
                    holder = slots[i].Holder,
                    original = originals[i],
                    chamfered = result.Mesh,
                    settings = settings,
                    placed = MeshScene.Place(modifier.transform, slots[i].Holder),
                    addedMaterials = MaterialSlots.Fill(slots[i], originals[i], result.Mesh, ChamferName)
                });
            }
            SlotEditing.Changed(modifier);
        }

        private static void Write(JobResult result, MeshSlot slot, Mesh original, ChamferedMesh[] former)
        {
            var ours = former.FirstOrDefault(entry => entry.original == original).chamfered;
            SlotEditing.Write(result, slot.Holder, ours, ChamferName);
        }

        private static void DropUnused(ChamferModifier modifier, ChamferedMesh[] former)
        {
            var used = new HashSet<Mesh>(modifier.meshes.ConvertAll(entry => entry.chamfered));
            foreach (var entry in former)
            {
                if (entry.chamfered == null || entry.holder == null || !used.Add(entry.chamfered)) { continue; }
                SlotEditing.DropFromPrefab(entry.chamfered, entry.holder);
            }
        }

        private static string FileName(Mesh mesh)
        {
            return string.Join("_", mesh.name.Split(Path.GetInvalidFileNameChars()));
        }
    }
}
