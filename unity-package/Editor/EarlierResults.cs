using System;
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Files that were saved beside mesh assets at an earlier time. Each folder is looked through once.</summary>
    internal sealed class EarlierResults
    {
        private readonly Dictionary<string, Dictionary<Mesh, Mesh>> folders = new Dictionary<string, Dictionary<Mesh, Mesh>>();

        /// <summary>The mesh that was made of a source and lies beside it, whatever it is called now; or null.</summary>
        internal Mesh Of(Mesh source)
        {
            string folder = AssetNames.FolderBeside(source);
            Dictionary<Mesh, Mesh> results;
            if (!folders.TryGetValue(folder, out results)) { folders[folder] = results = ResultsIn(folder); }
            Mesh earlier;
            return results.TryGetValue(source, out earlier) ? earlier : null;
        }

        /// <summary>Whether an earlier mesh is what would be written now.</summary>
        internal static bool IsCurrent(Mesh earlier, JobResult result)
        {
            var record = ChamferRecords.Of(earlier);
            string now = MeshKeys.Of(result.Source);
            return now != MeshKeys.Unknown && record.sourceKey == now && SettingsText.Of(record.settings) == SettingsText.Of(result.Settings);
        }

        /// <summary>By source; of several, the first by name.</summary>
        private static Dictionary<Mesh, Mesh> ResultsIn(string folder)
        {
            var results = new Dictionary<Mesh, Mesh>();
            var guids = AssetDatabase.FindAssets("t:Mesh", new[] { folder });
            var paths = guids.Select(guid => AssetDatabase.GUIDToAssetPath(guid));
            foreach (string path in paths.Distinct().OrderBy(path => path, StringComparer.Ordinal))
            {
                bool isBeside = AssetNames.Folder(path) == folder && path.EndsWith(".asset", StringComparison.Ordinal);
                var record = isBeside ? AssetDatabase.LoadAssetAtPath<ChamferRecord>(path) : null;
                bool isResult = record != null && record.source != null && !record.isManaged;
                if (!isResult || results.ContainsKey(record.source)) { continue; }
                results.Add(record.source, AssetDatabase.LoadAssetAtPath<Mesh>(path));
            }
            return results;
        }
    }
}
