using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The menu entries for what is chamfered already.</summary>
    internal static class ModifierMenu
    {
        private const string Revert = "Tools/Revert Chamfer";
        private const string Scenes = "Tools/Chamfer All Again in Open Scenes";
        private const string Project = "Tools/Chamfer All Again in Project";

        [MenuItem(Revert, false)]
        internal static void RunRevert()
        {
            RevertSelection.Run(RevertSelection.Find(Selection.objects));
        }

        [MenuItem(Revert, true)]
        internal static bool CanRevert()
        {
            return RevertSelection.Find(Selection.objects).Any();
        }

        [MenuItem(Scenes, false)]
        internal static void RunInScenes()
        {
            var summary = new JobSummary();
            Tell(ChamferAgain.InScenes(summary), summary);
        }

        [MenuItem(Project, false)]
        internal static void RunInProject()
        {
            var summary = new JobSummary();
            Tell(ChamferAgain.InProject(summary), summary);
        }

        private static void Tell(bool isDone, JobSummary summary)
        {
            string text = "Chamfer: " + (isDone ? summary.ToString() : "cancelled, nothing was changed");
            if (summary.HasFailed) { Debug.LogWarning(text); }
            else { Debug.Log(text); }
        }
    }
}
