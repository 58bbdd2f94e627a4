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
        private readonly Dictionary<Mesh, JobResult> shared;

        internal ModifierRun(ChamferModifier modifier, ChamferSettings settings)
        {
            this.modifier = modifier;
            this.settings = settings;
            slots = ModifierSlots.Of(modifier);
            originals = slots.ConvertAll(loaded.Original);
            scene = MeshScene.Of(modifier.transform, slots, loaded.Original);
            shared = Shared();
        }

        /// <summary>One sentence for each mesh that could not be chamfered.</summary>
        internal IReadOnlyList<string> Failures => job.Failures;

        /// <summary>What came of each mesh that was not shared.</summary>
        internal ChamferJob Job => job;

        /// <summary>The originals as they stand.</summary>
        internal MeshScene Scene => scene;

        /// <summary>Whether somebody else made all of it already, so that it takes no time.</summary>
        internal bool IsShared => originals.All(shared.ContainsKey);

        /// <summary>False if the user cancelled; then nothing was changed.</summary>
        internal bool TryChamfer()
        {
            if (!IsShared && !job.Run(new[] { scene }, settings)) { return false; }
            Apply(job.Results.Values);
            return true;
        }

        /// <summary>Puts in what was made elsewhere.</summary>
        internal void Apply(IEnumerable<SceneResult> results)
        {
            Apply(results.Select(result => new JobResult(result, settings, scene.KeyOf(result.Mesh, settings))).ToList());
        }

        private void Apply(IEnumerable<JobResult> made)
        {
            // It may be gone since the preview began.
            var results = shared.Values.Where(result => result.Mesh != null).ToDictionary(result => result.Source);
            foreach (var result in made) { results[result.Source] = result; }
            var former = TakeOver();
            for (int i = 0; i < slots.Count; i++)
            {
                JobResult result;
                if (slots[i].Holder != null && results.TryGetValue(originals[i], out result)) { Put(slots[i], result, former); }
            }
            SlotEditing.Changed(modifier);
            ModifierActions.DropUnused(former);
        }

        private Dictionary<Mesh, JobResult> Shared()
        {
            var results = new Dictionary<Mesh, JobResult>();
            for (int i = 0; i < slots.Count; i++)
            {
                string key = scene.KeyOf(originals[i], settings);
                var result = SharedMeshes.Find(loaded, originals[i], key, slots[i].Holder, modifier);
                if (result != null) { results[originals[i]] = result; }
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
            // Since the preview began, others may have changed.
            var now = new LoadedModifiers();
            foreach (var slot in slots)
            {
                LoadedModifiers.Place place;
                if (slot.Holder == null || !now.TryFind(slot, out place) || place.Modifier == modifier) { continue; }
                former.Add(place.Entry);
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
