using UnityEngine;

namespace Chamfer
{
    /// <summary>Settings that many objects, rules and build machines share: change them here, and all follow.</summary>
    [CreateAssetMenu(fileName = "Chamfer Preset", menuName = "Chamfer Preset")]
    [HelpURL(PackageLinks.Documentation)]
    public sealed class ChamferPreset : ScriptableObject
    {
        [SerializeField] internal ChamferSettings settings = ChamferSettings.Default;

        /// <summary>How meshes are chamfered.</summary>
        public ChamferSettings Settings
        {
            get { return settings.Copy(); }
            set { settings = value.Copy(); }
        }
    }
}
