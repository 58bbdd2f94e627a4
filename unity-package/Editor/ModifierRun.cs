using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Chamfers what a modifier has to chamfer, from the originals on.</summary>
    internal sealed class ModifierRun
    {
        private const string Action = "Chamfer";

        /// <summary>Milliseconds that a preview may take before it shows progress.</summary>
        private const double Patience = 500;

        private readonly ChamferModifier modifier;
        private readonly ChamferSettings settings;
        private readonly LoadedModifiers loaded = new LoadedModifiers();
        private readonly ChamferJob job = new ChamferJob(Patience);
        private readonly List<MeshSlot> slots;
        private readonly List<Mesh> originals;
        private readonly MeshScene scene;

        internal ModifierRun(ChamferModifier modifier, ChamferSettings settings)
        {
            this.modifier = modifier;
            this.settings = settings;
            slots = ModifierSlots.Of(modifier);
            originals = slots.ConvertAll(loaded.Original);
            scene = MeshScene.Of(modifier.transform, slots, loaded.Original);
        }

        /// <summary>One sentence for each mesh that could not be chamfered.</summary>
        internal IReadOnlyList<string> Failures => job.Failures;

        /// <summary>What came of each mesh that was not shared.</summary>
        internal ChamferJob Job => job;

        /// <summary>False if the user cancelled; then nothing was changed.</summary>
        internal bool TryChamfer()
        {
            var results = Shared();
            // What somebody else made already takes no time.
            if (originals.Any(mesh => !results.ContainsKey(mesh)) && !job.Run(new[] { scene }, settings)) { return false; }
            foreach (var result in job.Results) { results[result.Key] = result.Value; }
            var former = TakeOver();
            for (int i = 0; i < slots.Count; i++)
            {
                JobResult result;
                if (results.TryGetValue(originals[i], out result)) { Put(slots[i], result, former); }
            }
            SlotEditing.Changed(modifier);
            ModifierActions.DropUnused(former);
            return true;
        }

        private Dictionary<Mesh, JobResult> Shared()
        {
            var results = new Dictionary<Mesh, JobResult>();
            for (int i = 0; i < slots.Count; i++)
            {
                string key = scene.KeyOf(originals[i], settings);
                var mesh = SharedMeshes.Find(loaded, originals[i], key, slots[i].Holder, modifier);
                if (mesh != null) { results[originals[i]] = new JobResult(originals[i], mesh, settings, key); }
            }
            return results;
        }

        /// <summary>
        /// Puts the originals back, also where another modifier had chamfered an object that is this one's now, so that
        /// each is remembered once. Returns what was remembered.
        /// </summary>
        private List<ChamferedMesh> TakeOver()
        {
            var former = modifier.meshes.ToList();
            foreach (var slot in slots)
            {
                LoadedModifiers.Place place;
                if (!loaded.TryFind(slot, out place) || place.Modifier == modifier) { continue; }
                former.Add(place.Modifier.meshes.Find(entry => entry.holder == slot.Holder));
                ModifierActions.Restore(place.Modifier, slot.Holder, Action);
            }
            ModifierActions.Restore(modifier, Action);
            return former;
        }

        private void Put(MeshSlot slot, JobResult result, List<ChamferedMesh> former)
        {
            if (result.Mesh == null) { SlotEditing.Write(result, slot.Holder, Ours(result.Source, former), Action); }
            ModifierActions.Put(modifier, slot, result, MeshScene.Place(modifier.transform, slot.Holder), Action);
        }

        /// <summary>The former result of a source, if nobody else uses it.</summary>
        private static Mesh Ours(Mesh source, List<ChamferedMesh> former)
        {
            var ours = former.Find(entry => entry.original == source && entry.chamfered != null).chamfered;
            if (ours == null) { return null; }
            var holders = new HashSet<Component>(former.Where(entry => entry.chamfered == ours).Select(entry => entry.holder));
            return MeshUsers.HasOthers(ours, holders) ? null : ours;
        }
    }
}
