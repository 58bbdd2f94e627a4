using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Chamfers again what is chamfered, each with the settings that it has: sources have changed.</summary>
    internal static class ChamferAgain
    {
        private const string Action = "Chamfer All Again";

        /// <summary>All that is chamfered in the scenes, or in the prefab, that are open; false if cancelled.</summary>
        internal static bool InScenes(JobSummary summary)
        {
            var modifiers = Resources.FindObjectsOfTypeAll<ChamferModifier>();
            return Run(modifiers.Where(modifier => !EditorUtility.IsPersistent(modifier)), new Mesh[0], summary);
        }

        /// <summary>All that is chamfered in files of the project; false if cancelled.</summary>
        internal static bool InProject(JobSummary summary)
        {
            ModelImports.All();
            var prefabs = Paths("t:Prefab").Select(path => AssetDatabase.LoadAssetAtPath<GameObject>(path));
            var modifiers = prefabs.Where(prefab => prefab != null)
                .SelectMany(prefab => prefab.GetComponentsInChildren<ChamferModifier>(true));
            var files = Paths("t:Mesh").Where(path => path.EndsWith(".asset", StringComparison.Ordinal));
            return Run(modifiers, files.Select(path => AssetDatabase.LoadAssetAtPath<Mesh>(path)), summary);
        }

        /// <summary>In one undo step, all or nothing.</summary>
        private static bool Run(IEnumerable<ChamferModifier> modifiers, IEnumerable<Mesh> files, JobSummary summary)
        {
            using (var step = new SelectionStep(Action))
            {
                foreach (var modifier in modifiers.Where(IsDue).ToList())
                {
                    var run = new ModifierRun(modifier, modifier.Effective);
                    if (!run.TryChamfer()) { return false; }
                    summary.Add(run);
                    step.Touch(AssetDatabase.GetAssetPath(modifier));
                }
                foreach (var mesh in files.ToList())
                {
                    if (!Renew(mesh, step, summary)) { return false; }
                }
                step.Finish();
            }
            return true;
        }

        /// <summary>What a prefab's instances and variants have is the prefab's, unless they say otherwise.</summary>
        private static bool IsDue(ChamferModifier modifier)
        {
            if (!modifier.IsApplied || SlotEditing.IsLocked(modifier)) { return false; }
            var source = PrefabUtility.GetCorrespondingObjectFromSource(modifier);
            return source == null || !source.meshes.Select(entry => entry.chamfered)
                .SequenceEqual(modifier.meshes.Select(entry => entry.chamfered));
        }

        /// <summary>Writes a file anew whose source has changed.</summary>
        private static bool Renew(Mesh mesh, SelectionStep step, JobSummary summary)
        {
            var record = ChamferRecords.Of(mesh);
            if (record == null || record.source == null || record.sourceKey == MeshKeys.Of(record.source)) { return true; }
            var job = new ChamferJob();
            if (!job.Run(new[] { MeshScene.Of(record) }, record.settings)) { return false; }
            foreach (var result in job.Results.Values) { step.Rewrite(result, mesh); }
            summary.Add(job);
            return true;
        }

        private static IEnumerable<string> Paths(string filter)
        {
            var paths = AssetDatabase.FindAssets(filter).Select(guid => AssetDatabase.GUIDToAssetPath(guid));
            return paths.Distinct().OrderBy(path => path, StringComparer.Ordinal).ToList();
        }
    }
}
