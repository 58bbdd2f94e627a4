using System;
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>
    /// One undo step over many objects and files. Unless it is finished, all of it is taken back: files that were made,
    /// too.
    /// </summary>
    internal sealed class SelectionStep : IDisposable
    {
        private readonly List<string> created = new List<string>();
        private readonly HashSet<Object> touched = new HashSet<Object>();
        private readonly int group;
        private bool isFinished;

        internal SelectionStep(string action)
        {
            Action = action;
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName(action);
            group = Undo.GetCurrentGroup();
        }

        internal string Action { get; }

        /// <summary>Makes a file for a result.</summary>
        internal void Create(JobResult result, string path)
        {
            result.Write();
            created.Add(path);
            AssetDatabase.CreateAsset(result.Mesh, path);
            ChamferRecords.Write(result.Mesh, ChamferRecord.Make(result.Source, result.Settings));
            touched.Add(result.Mesh);
        }

        /// <summary>Writes the file of an earlier time anew.</summary>
        internal void Rewrite(JobResult result, Mesh earlier)
        {
            SlotEditing.Rewrite(result, earlier, Action);
            var record = ChamferRecords.Of(earlier);
            Undo.RecordObject(record, Action);
            record.settings = result.Settings.Copy();
            record.sourceKey = MeshKeys.Of(result.Source);
            EditorUtility.SetDirty(record);
            touched.Add(earlier);
        }

        /// <summary>Makes a file for a result that several prefabs use.</summary>
        internal void CreateShared(JobResult result, string prefab)
        {
            result.Write();
            created.Add(ManagedFiles.Make(result.Mesh, result.Source, result.Settings, prefab, ""));
        }

        /// <summary>A file in which something was changed.</summary>
        internal void Touch(string path)
        {
            if (path.Length > 0) { touched.Add(AssetDatabase.LoadMainAssetAtPath(path)); }
        }

        /// <summary>Saves what was changed, and nothing else: what the user has not saved yet is the user's.</summary>
        internal void Finish()
        {
            foreach (var asset in touched.Where(asset => asset != null)) { AssetDatabase.SaveAssetIfDirty(asset); }
            Undo.CollapseUndoOperations(group);
            isFinished = true;
        }

        public void Dispose()
        {
            if (isFinished) { return; }
            Undo.RevertAllDownToGroup(group);
            foreach (string path in created) { AssetDatabase.DeleteAsset(path); }
        }
    }
}
