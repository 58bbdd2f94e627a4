using System.Collections.Generic;
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
            return !selection.IsEmpty || selection.Reasons.Any() || Folders().Any();
        }

        internal static void Run()
        {
            var selection = new ChamferSelection(Selection.objects);
            var settings = ChamferProjectSettings.instance.settings;
            var folders = Folders().ToList();
            if (selection.IsEmpty && folders.Count == 0) { Explain(selection); }
            if (!selection.IsEmpty) { Tell(selection.Chamfer(settings), selection); }
            foreach (string folder in folders)
            {
                Debug.Log("Chamfer: " + folder + ": " + ChamferTools.ChamferFolder(folder, settings));
            }
        }

        private static IEnumerable<string> Folders()
        {
            return Selection.objects.Select(item => AssetDatabase.GetAssetPath(item)).Where(AssetDatabase.IsValidFolder);
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
