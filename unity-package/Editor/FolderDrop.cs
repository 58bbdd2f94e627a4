using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Folders that are dragged onto the settings page become rules.</summary>
    internal static class FolderDrop
    {
        private const float Height = 32;

        /// <summary>Draws the place to drop on; true if rules were added.</summary>
        internal static bool Draw(ChamferProjectSettings project)
        {
            var area = GUILayoutUtility.GetRect(0, Height, GUILayout.ExpandWidth(true));
            GUI.Box(area, "Drop folders here to chamfer the models in them");
            var happens = Event.current;
            bool isHere = area.Contains(happens.mousePosition) && Folders(DragAndDrop.paths).Any();
            if (!isHere || happens.type != EventType.DragUpdated && happens.type != EventType.DragPerform) { return false; }
            DragAndDrop.visualMode = DragAndDropVisualMode.Link;
            if (happens.type == EventType.DragUpdated) { return false; }
            DragAndDrop.AcceptDrag();
            return Add(project, DragAndDrop.paths);
        }

        /// <summary>Adds a rule for each folder that has none; false if there was nothing to add.</summary>
        internal static bool Add(ChamferProjectSettings project, IEnumerable<string> paths)
        {
            var added = Folders(paths).Where(path => project.rules.All(rule => rule.Folder != path)).ToList();
            if (added.Count == 0) { return false; }
            Undo.RecordObject(project, "Add Chamfer Rule");
            project.rules.AddRange(added.Select(path => new ModelRule { folder = path }));
            return true;
        }

        private static IEnumerable<string> Folders(IEnumerable<string> paths)
        {
            return paths.Where(AssetDatabase.IsValidFolder);
        }
    }
}
