using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>The entry "Chamfer" in the menus of components that hold a mesh.</summary>
    internal static class ComponentMenu
    {
        private const string Filter = "CONTEXT/MeshFilter/Chamfer";
        private const string Skinned = "CONTEXT/SkinnedMeshRenderer/Chamfer";

        [MenuItem(Filter, false)]
        [MenuItem(Skinned, false)]
        internal static void Run(MenuCommand command)
        {
            var holder = (Component)command.context;
            Undo.IncrementCurrentGroup();
            var modifier = ModifierSlots.Owner(holder);
            if (modifier == null)
            {
                modifier = Undo.AddComponent<ChamferModifier>(holder.gameObject);
                modifier.settings = ChamferProjectSettings.instance.settings.Copy();
                modifier.LeaveOutOfBuilds();
            }
            foreach (string failure in ModifierActions.Chamfer(modifier)) { Debug.LogWarning(failure, holder); }
        }

        [MenuItem(Filter, true)]
        [MenuItem(Skinned, true)]
        internal static bool CanRun(MenuCommand command)
        {
            var holder = (Component)command.context;
            var mesh = MeshSlot.Of(holder).Mesh;
            return mesh != null && !SlotEditing.IsLocked(holder) && !ChamferRecords.IsResult(mesh);
        }
    }
}
