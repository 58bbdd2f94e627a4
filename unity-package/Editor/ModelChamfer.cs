using System;
using System.Collections.Generic;
using System.Threading;
using Chamfer;
using Chamfer.Streams;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Chamfers models when they are imported, if a label or a folder asks for it.</summary>
    internal sealed class ModelChamfer : AssetPostprocessor
    {
        /// <summary>Raise it when the same model comes out otherwise, so that Unity imports it again.</summary>
        private const uint Version = 2;

        public override uint GetVersion()
        {
            return Version;
        }

        private void OnPostprocessModel(GameObject root)
        {
            try
            {
                ChamferSettings settings;
                if (!TryFindSettings(out settings)) { return; }
                context.DependsOnCustomDependency(ImportDependency.Name);
                Process(root, settings, (message, mesh) => context.LogImportWarning(message, mesh));
            }
            // An import must never break because of a chamfer.
            catch (Exception exception) { context.LogImportWarning("Not chamfered: " + exception.Message, root); }
        }

        /// <summary>Chamfers all meshes below the root in place; tells what could not be.</summary>
        private static void Process(GameObject root, ChamferSettings settings, Action<string, Mesh> warn)
        {
            var slots = MeshSlot.In(root, true);
            var submeshes = new Dictionary<Mesh, int>();
            foreach (var slot in slots) { submeshes[slot.Mesh] = slot.Mesh.subMeshCount; }
            var scene = MeshScene.Of(root.transform, slots);
            var results = SceneRun.Run(scene.Objects, settings, null, CancellationToken.None,
                (why, mesh) => warn("Not chamfered: " + why, mesh));
            foreach (var result in results) { MeshWriter.Overwrite(result.Mesh, result.Output.Mesh, result.Mesh); }
            foreach (var slot in slots)
            {
                int before = submeshes[slot.Mesh];
                MaterialSlots.FillImported(slot, before, slot.Mesh.subMeshCount - before);
            }
        }

        private bool TryFindSettings(out ChamferSettings settings)
        {
            var project = ChamferProjectSettings.instance;
            var labels = AssetDatabase.GetLabels(AssetDatabase.GUIDFromAssetPath(assetPath));
            return ImportRule.TryFind(assetPath, labels, project.settings, project.folders, out settings);
        }
    }
}
