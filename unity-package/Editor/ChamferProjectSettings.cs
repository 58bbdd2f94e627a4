using System;
using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEditorInternal;
using UnityEngine;
using UnityEngine.Serialization;
using Object = UnityEngine.Object;

namespace ChamferEditor
{
    /// <summary>What Project Settings > Chamfer keeps, in a file that the whole team has.</summary>
    internal sealed class ChamferProjectSettings : ScriptableObject
    {
        internal const string File = "ProjectSettings/ChamferSettings.asset";

        private static ChamferProjectSettings made;

        [Tooltip("Settings that others share; they go before those below.")]
        [SerializeField] internal ChamferPreset preset;

        [Tooltip("For the menu entry, and for models with the label Chamfer.")]
        [SerializeField] internal ChamferSettings settings = Usual();

        [Tooltip("Models that these concern are chamfered when they are imported.")]
        [SerializeField, FormerlySerializedAs("folders")] internal List<ModelRule> rules = new List<ModelRule>();

        [NonSerialized] private string written;

        /// <summary>The settings that the page edits.</summary>
        internal static ChamferProjectSettings instance
        {
            get
            {
                if (made == null) { made = Load(); }
                return made;
            }
        }

        /// <summary>
        /// The settings as the file has them. Whoever imports reads them so: a process that helps with importing has
        /// started before the last change.
        /// </summary>
        internal static ChamferProjectSettings Load()
        {
            var loaded = InternalEditorUtility.LoadSerializedFileAndForget(File).OfType<ChamferProjectSettings>();
            var settings = loaded.FirstOrDefault() ?? CreateInstance<ChamferProjectSettings>();
            // Unity would make it not editable.
            settings.hideFlags = HideFlags.HideAndDontSave & ~HideFlags.NotEditable;
            settings.written = ImportDependency.Text(settings);
            return settings;
        }

        /// <summary>Nobody looks at each model of a folder, so that is done here.</summary>
        internal static ChamferSettings Usual()
        {
            var settings = ChamferSettings.Default;
            settings.verify = VerifyMode.Seen;
            return settings;
        }

        internal void Write()
        {
            PresetSync.Copy(this);
            InternalEditorUtility.SaveToSerializedFileAndForget(new Object[] { this }, File, true);
            written = ImportDependency.Text(this);
        }

        /// <summary>Undo changes the object only; the file has to follow.</summary>
        [InitializeOnLoadMethod]
        internal static void Listen()
        {
            Undo.undoRedoPerformed -= WriteIfChanged;
            Undo.undoRedoPerformed += WriteIfChanged;
        }

        private static void WriteIfChanged()
        {
            if (made != null && ImportDependency.Text(made) != made.written) { made.Write(); }
        }
    }
}
