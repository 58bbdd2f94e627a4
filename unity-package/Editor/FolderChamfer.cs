using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>Chamfers all models, prefabs and mesh files of a folder.</summary>
    internal static class FolderChamfer
    {
        /// <summary>False if the user cancelled.</summary>
        internal static bool Run(string folder, ChamferSettings settings, JobSummary summary)
        {
            // Models first: prefabs made of them then have nothing left to chamfer.
            foreach (string path in Paths("t:Model", folder))
            {
                if (!RunModel(path, settings, summary)) { return false; }
            }
            var selected = new List<Object>();
            selected.AddRange(Paths("t:Prefab", folder).Select(path => AssetDatabase.LoadAssetAtPath<GameObject>(path)));
            var meshes = Paths("t:Mesh", folder).Where(IsSource);
            selected.AddRange(meshes.Select(path => AssetDatabase.LoadAssetAtPath<Mesh>(path)));
            return new ChamferSelection(selected.Where(item => item != null)).Chamfer(settings, summary);
        }

        /// <summary>
        /// A model's file cannot be changed, but its import can: a label asks for it. What was imported with that label
        /// is left alone.
        /// </summary>
        private static bool RunModel(string path, ChamferSettings settings, JobSummary summary)
        {
            var record = AssetDatabase.LoadAssetAtPath<ChamferRecord>(path);
            string label = ImportRule.LabelOf(settings);
            var labels = AssetDatabase.GetLabels(AssetDatabase.GUIDFromAssetPath(path));
            if (record != null && labels.Where(ImportRule.IsLabel).SequenceEqual(new[] { label }))
            {
                summary.AddImported(record, true);
                return true;
            }
            bool isChamfered = record != null;
            if (!isChamfered)
            {
                // What an import could not do is only told in the console, so its meshes are tried here.
                var job = new ChamferJob();
                if (!job.Run(Scenes(path), settings)) { return false; }
                summary.Add(job);
                if (job.Results.Values.All(result => result.Report.HardEdges == 0)) { return true; }
            }
            Import(path, labels.Where(other => !ImportRule.IsLabel(other)).Concat(new[] { label }).ToArray());
            // What was imported before is chamfered, and could not be tried. Its record is another one now.
            if (isChamfered) { summary.AddImported(AssetDatabase.LoadAssetAtPath<ChamferRecord>(path), false); }
            return true;
        }

        private static void Import(string path, string[] labels)
        {
            AssetDatabase.SetLabels(AssetDatabase.LoadMainAssetAtPath(path), labels);
            ImportDependency.RegisterLabels();
            AssetDatabase.ImportAsset(path, ImportAssetOptions.ForceUpdate);
        }

        /// <summary>The model as a whole, and each mesh that stands nowhere in it.</summary>
        private static List<MeshScene> Scenes(string path)
        {
            var scenes = new List<MeshScene>();
            var root = AssetDatabase.LoadMainAssetAtPath(path) as GameObject;
            if (root != null) { scenes.Add(MeshScene.Of(root.transform, MeshSlot.In(root, true))); }
            scenes.AddRange(AssetDatabase.LoadAllAssetsAtPath(path).OfType<Mesh>().Select(mesh => MeshScene.Of(mesh)));
            return scenes;
        }

        /// <summary>Whether a file holds a mesh of its own that is no result of an earlier time.</summary>
        private static bool IsSource(string path)
        {
            return path.EndsWith(".asset", StringComparison.Ordinal)
                && !path.EndsWith(JobResult.Suffix + ".asset", StringComparison.Ordinal)
                && AssetDatabase.LoadAssetAtPath<ChamferRecord>(path) == null;
        }

        /// <summary>Sorted, so that each run does the same in the same order.</summary>
        private static IEnumerable<string> Paths(string filter, string folder)
        {
            var guids = AssetDatabase.FindAssets(filter, new[] { folder });
            var paths = guids.Select(guid => AssetDatabase.GUIDToAssetPath(guid));
            return paths.Distinct().OrderBy(path => path, StringComparer.Ordinal);
        }
    }
}
