using System;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Files that were saved beside a mesh asset at an earlier time.</summary>
    internal static class EarlierResults
    {
        /// <summary>The mesh that was made of a source and lies in its folder, whatever it is called now; or null.</summary>
        internal static Mesh Of(Mesh source)
        {
            string folder = AssetNames.Folder(AssetDatabase.GetAssetPath(source));
            var paths = AssetDatabase.FindAssets("t:Mesh", new[] { folder }).Select(guid => AssetDatabase.GUIDToAssetPath(guid));
            foreach (string path in paths.Distinct().OrderBy(path => path, StringComparer.Ordinal))
            {
                bool isBeside = AssetNames.Folder(path) == folder && path.EndsWith(".asset", StringComparison.Ordinal);
                var record = isBeside ? AssetDatabase.LoadAssetAtPath<ChamferRecord>(path) : null;
                if (record != null && record.source == source && !record.isManaged) { return AssetDatabase.LoadAssetAtPath<Mesh>(path); }
            }
            return null;
        }

        /// <summary>Whether an earlier mesh is what would be written now.</summary>
        internal static bool IsCurrent(Mesh earlier, JobResult result)
        {
            var record = ChamferRecords.Of(earlier);
            string now = MeshKeys.Of(result.Source);
            return now != MeshKeys.Unknown && record.sourceKey == now && record.settings.Equals(result.Settings);
        }
    }
}
