using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The menu entries "Chamfer selected".</summary>
    internal static class ChamferMenu
    {
        private const string Tools = "Tools/Chamfer Selected";
        private const string GameObjects = "GameObject/Chamfer Selected";
        private const string Assets = "Assets/Chamfer Selected";

        private static bool isComing;

        [MenuItem(Tools, false)]
        private static void RunFromTools()
        {
            Run();
        }

        /// <summary>Unity calls entries of this menu once for each selected object, in any order.</summary>
        [MenuItem(GameObjects, false, 49)]
        private static void RunFromGameObject(MenuCommand command)
        {
            if (isComing) { return; }
            isComing = true;
            EditorApplication.delayCall += () =>
            {
                isComing = false;
                Run();
            };
        }

        [MenuItem(Assets, false, 1100)]
        private static void RunFromAssets()
        {
            Run();
        }

        /// <summary>Also where there is only something to say: an entry that is grey does not tell why.</summary>
        [MenuItem(Tools, true)]
        [MenuItem(GameObjects, true)]
        [MenuItem(Assets, true)]
        internal static bool CanRun()
        {
            var selection = new ChamferSelection(Selection.objects);
            return !selection.IsEmpty || selection.Reasons.Any();
        }

        internal static void Run()
        {
            var selection = new ChamferSelection(Selection.objects);
            if (selection.IsEmpty) { Explain(selection); }
            else { Tell(selection.Chamfer(ChamferProjectSettings.instance.settings), selection); }
        }

        private static void Explain(ChamferSelection selection)
        {
            string why = string.Join("\n", selection.Reasons);
            if (why.Length > 0) { EditorUtility.DisplayDialog("Chamfer", "Nothing was chamfered.\n" + why, "OK"); }
        }

        private static void Tell(JobSummary summary, ChamferSelection selection)
        {
            string text = summary != null ? summary.ToString() : "cancelled, nothing was changed";
            foreach (string why in selection.Reasons) { text += "\nleft alone: " + why; }
            if (summary != null && summary.HasFailed) { Debug.LogWarning("Chamfer: " + text); }
            else { Debug.Log("Chamfer: " + text); }
        }
    }
}
