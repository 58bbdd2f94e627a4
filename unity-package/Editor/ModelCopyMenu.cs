using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The menu entry "Chamfer Model Asset".</summary>
    internal static class ModelCopyMenu
    {
        private const string Entry = "Assets/Chamfer Model Asset";

        [MenuItem(Entry, false, 1101)]
        internal static void Run()
        {
            var summary = new JobSummary();
            foreach (var model in Selection.objects.Where(ModelCopy.IsModel).Cast<GameObject>())
            {
                if (!ModelCopy.Make(model, ChamferProjectSettings.instance.settings, summary)) { break; }
            }
            if (summary.HasFailed) { Debug.LogWarning("Chamfer: " + summary); }
            else { Debug.Log("Chamfer: " + summary); }
        }

        [MenuItem(Entry, true)]
        internal static bool CanRun()
        {
            return Selection.objects.Any(ModelCopy.IsModel);
        }
    }
}
