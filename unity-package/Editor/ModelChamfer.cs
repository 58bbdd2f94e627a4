using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Chamfer;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>Chamfers models when they are imported, if a label or a rule asks for it.</summary>
    internal sealed class ModelChamfer : AssetPostprocessor
    {
        /// <summary>Raise it when the same model comes out otherwise, so that Unity imports it again.</summary>
        private const uint Version = 3;

        private readonly List<string> failures = new List<string>();

        public override uint GetVersion()
        {
            return Version;
        }

        private void OnPostprocessModel(GameObject root)
        {
            try
            {
                foreach (string name in ImportDependency.Of(assetPath)) { context.DependsOnCustomDependency(name); }
                var facts = ModelFacts.At(assetPath).With(MeshSlot.In(root, true).Select(slot => slot.Mesh));
                ChamferSettings settings;
                if (!TryFindSettings(facts, out settings)) { return; }
                context.DependsOnCustomDependency(ImportDependency.Settings);
                Record(facts, settings, Process(root, settings));
            }
            // An import must never break because of a chamfer.
            catch (Exception exception) { Warn(exception.Message, root); }
        }

        /// <summary>Chamfers all meshes below the root in place; warns of what could not be.</summary>
        private List<SceneResult> Process(GameObject root, ChamferSettings settings)
        {
            var slots = MeshSlot.In(root, true);
            var submeshes = new Dictionary<Mesh, int>();
            foreach (var slot in slots) { submeshes[slot.Mesh] = slot.Mesh.subMeshCount; }
            var scene = MeshScene.Of(root.transform, slots);
            var results = SceneRun.Run(scene.Objects, settings, null, CancellationToken.None, (why, mesh) => Warn(why, mesh));
            foreach (var result in results) { MeshWriter.Overwrite(result.Mesh, result.Output.Mesh, result.Mesh); }
            foreach (var slot in slots)
            {
                int before = submeshes[slot.Mesh];
                MaterialSlots.FillImported(slot, before, slot.Mesh.subMeshCount - before);
            }
            return results;
        }

        /// <summary>Writes down what was done: others must not chamfer it once more.</summary>
        private void Record(ModelFacts facts, ChamferSettings settings, List<SceneResult> results)
        {
            foreach (var result in results)
            {
                if (result.Output.Report.Quads > 0) { Warn(QuadsText.Of(result.Mesh), result.Mesh); }
            }
            var record = ChamferRecord.Make(null, settings);
            record.triangles = facts.Triangles;
            record.size = facts.Size;
            record.report = string.Join("\n", results.Select(result => result.Mesh.name + ": " + result.Output.Report));
            record.failures = failures.ToArray();
            context.AddObjectToAsset("Chamfer Record", record);
        }

        private void Warn(string why, Object about)
        {
            failures.Add(why);
            context.LogImportWarning("Not chamfered: " + why, about);
        }

        /// <summary>From the file: a process that helps with importing has started before the last change.</summary>
        private static bool TryFindSettings(ModelFacts facts, out ChamferSettings settings)
        {
            var project = ChamferProjectSettings.Load();
            try { return ImportRule.TryFind(facts, project.settings, project.rules, out settings); }
            finally { Object.DestroyImmediate(project); }
        }
    }
}
