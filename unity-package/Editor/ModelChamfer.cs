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
        private const uint Version = 1;

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

        /// <summary>Chamfers each mesh below the root in place; tells what could not be.</summary>
        private static void Process(GameObject root, ChamferSettings settings, Action<string, Mesh> warn)
        {
            var submeshes = new Dictionary<Mesh, int>();
            foreach (var slot in MeshSlot.In(root, true))
            {
                var mesh = slot.Mesh;
                if (!submeshes.ContainsKey(mesh))
                {
                    submeshes.Add(mesh, mesh.subMeshCount);
                    ChamferInPlace(mesh, settings, warn);
                }
                MaterialSlots.FillImported(slot, submeshes[mesh], mesh.subMeshCount - submeshes[mesh]);
            }
        }

        private static void ChamferInPlace(Mesh mesh, ChamferSettings settings, Action<string, Mesh> warn)
        {
            try
            {
                var result = ArrayChamfer.Run(MeshReader.Read(mesh), settings, null, CancellationToken.None);
                MeshWriter.Overwrite(mesh, result.Mesh);
            }
            catch (ChamferException exception) { warn("Not chamfered: " + exception.Message, mesh); }
        }

        private bool TryFindSettings(out ChamferSettings settings)
        {
            var project = ChamferProjectSettings.instance;
            var labels = AssetDatabase.GetLabels(AssetDatabase.GUIDFromAssetPath(assetPath));
            return ImportRule.TryFind(assetPath, labels, project.settings, project.folders, out settings);
        }
    }
}
