using System;
using System.Collections.Generic;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What Project Settings > Chamfer keeps.</summary>
    [FilePath("ProjectSettings/ChamferSettings.asset", FilePathAttribute.Location.ProjectFolder)]
    internal sealed class ChamferProjectSettings : ScriptableSingleton<ChamferProjectSettings>
    {
        [Tooltip("For the menu entry, and for models with the label Chamfer.")]
        [SerializeField] internal ChamferSettings settings = Usual();

        [Tooltip("Models in these folders are chamfered when they are imported.")]
        [SerializeField] internal List<FolderRule> folders = new List<FolderRule>();

        /// <summary>Nobody looks at each model of a folder, so that is done here.</summary>
        internal static ChamferSettings Usual()
        {
            var settings = ChamferSettings.Default;
            settings.verify = VerifyMode.Seen;
            return settings;
        }

        internal void Write()
        {
            Save(true);
        }
    }

    /// <summary>A folder whose models are chamfered.</summary>
    [Serializable]
    internal struct FolderRule
    {
        [Tooltip("Such as Assets/Models.")]
        public string folder;

        [Tooltip("At width 0, the settings for all models count.")]
        public ChamferSettings settings;

        /// <summary>Without a slash at its end, which users may write; never null.</summary>
        internal string Folder => (folder ?? "").TrimEnd('/');
    }
}
