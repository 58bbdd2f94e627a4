using System;
using System.Collections.Generic;
using Chamfer;
using UnityEngine;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>What menus and inspectors do, for scripts of the editor. Every call is one undo step.</summary>
    public static class ChamferTools
    {
        /// <summary>The settings of Project Settings > Chamfer.</summary>
        public static ChamferSettings ProjectSettings => ChamferProjectSettings.instance.settings.Copy();

        /// <summary>
        /// Chamfers objects, prefabs and mesh assets, as Tools > Chamfer Selected does: objects get a modifier, mesh
        /// assets a file beside them.
        /// </summary>
        public static ChamferOutcome Chamfer(IEnumerable<Object> items, ChamferSettings settings)
        {
            var summary = new JobSummary();
            return new ChamferOutcome(new ChamferSelection(items).Chamfer(settings, summary), summary);
        }

        /// <summary>Chamfers the models, prefabs and mesh assets of a folder, as build machines do.</summary>
        public static ChamferOutcome ChamferFolder(string folder, ChamferSettings settings)
        {
            var summary = new JobSummary();
            return new ChamferOutcome(FolderChamfer.Run(folder, settings, summary), summary);
        }

        /// <summary>Makes a chamfered copy of a model beside it: a prefab variant.</summary>
        /// <exception cref="ArgumentException">It is no model.</exception>
        public static ChamferOutcome ChamferModelCopy(GameObject model, ChamferSettings settings)
        {
            if (!ModelCopy.IsModel(model))
            {
                throw new ArgumentException("Hand over the main object of a model file", nameof(model));
            }
            var summary = new JobSummary();
            return new ChamferOutcome(ModelCopy.Make(model, settings, summary), summary);
        }

        /// <summary>Presses the modifier's button Chamfer; returns what could not be chamfered.</summary>
        public static IReadOnlyList<string> Apply(ChamferModifier modifier)
        {
            return ModifierActions.Chamfer(modifier);
        }

        /// <summary>Gives objects, and all below, their originals back.</summary>
        public static void Revert(IEnumerable<Object> items)
        {
            RevertSelection.Run(RevertSelection.Find(items));
        }

        /// <summary>Chamfers again what is chamfered in open scenes, each with its own settings.</summary>
        public static ChamferOutcome ChamferScenesAgain()
        {
            var summary = new JobSummary();
            return new ChamferOutcome(ChamferAgain.InScenes(summary), summary);
        }

        /// <summary>Whether a source has changed since it was chamfered.</summary>
        public static bool IsOutOfDate(ChamferModifier modifier)
        {
            return ModifierState.IsOutdated(modifier);
        }
    }
}
