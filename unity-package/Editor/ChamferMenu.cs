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

        [MenuItem(Tools, false)]
        private static void RunFromTools()
        {
            Run();
        }

        [MenuItem(GameObjects, false, 49)]
        private static void RunFromGameObject(MenuCommand command)
        {
            // Unity calls entries of this menu once for each selected object.
            if (command.context == null || command.context == Selection.objects[0]) { Run(); }
        }

        [MenuItem(Assets, false, 1100)]
        private static void RunFromAssets()
        {
            Run();
        }

        [MenuItem(Tools, true)]
        [MenuItem(GameObjects, true)]
        [MenuItem(Assets, true)]
        internal static bool CanRun()
        {
            return !new ChamferSelection(Selection.objects).IsEmpty;
        }

        internal static void Run()
        {
            var summary = new ChamferSelection(Selection.objects).Chamfer(ChamferProjectSettings.instance.settings);
            string text = "Chamfer: " + (summary != null ? summary.ToString() : "cancelled, nothing was changed");
            if (summary != null && summary.HasFailed) { Debug.LogWarning(text); }
            else { Debug.Log(text); }
        }
    }
}
