using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Gives selected objects their originals back, long after undo has forgotten them.</summary>
    internal static class RevertSelection
    {
        private const string Action = "Revert Chamfer";

        /// <summary>The modifiers of selected objects, and of what is below them.</summary>
        internal static List<ChamferModifier> Find(IEnumerable<Object> selected)
        {
            var found = selected.OfType<GameObject>().SelectMany(item => item.GetComponentsInChildren<ChamferModifier>(true));
            return found.Where(modifier => modifier.IsApplied && !SlotEditing.IsLocked(modifier)).Distinct().ToList();
        }

        /// <summary>In one undo step; modifiers that the menu made go as well.</summary>
        internal static void Run(IEnumerable<ChamferModifier> modifiers)
        {
            using (var step = new SelectionStep(Action))
            {
                foreach (var modifier in modifiers)
                {
                    ModifierActions.Revert(modifier);
                    step.Touch(AssetDatabase.GetAssetPath(modifier));
                    if (modifier.isFromMenu) { Undo.DestroyObjectImmediate(modifier); }
                }
                step.Finish();
            }
        }
    }
}
