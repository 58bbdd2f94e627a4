using System;
using System.Collections.Generic;
using UnityEngine;

namespace Chamfer
{
    /// <summary>
    /// Remembers how the meshes of an object were chamfered, and what they were before. It does nothing while
    /// the game runs: its inspector does the work, and players do not have it.
    /// </summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Mesh/Chamfer Modifier")]
    [HelpURL(PackageLinks.Documentation)]
    [Icon("Packages/com.chamfer.unity/Editor/Icons/ChamferModifier.png")]
    public sealed class ChamferModifier : MonoBehaviour
    {
        [SerializeField] internal ChamferSettings settings = ChamferSettings.Default;

        [SerializeField, Tooltip("Also chamfer the meshes of all children that have no modifier of their own.")]
        internal bool includeChildren;

        [SerializeField, Tooltip("Chamfer anew whenever a setting changes.")]
        internal bool livePreview = true;

        [SerializeField, Tooltip("Draw each hard edge in the colour of what became of it.")]
        internal bool showEdges;

        /// <summary>How the meshes are chamfered, the next time that they are.</summary>
        public ChamferSettings Settings
        {
            get { return settings.Copy(); }
            set { settings = value.Copy(); }
        }

        /// <summary>Whether the meshes of children are chamfered, too, but for those of modifiers below.</summary>
        public bool IncludeChildren
        {
            get { return includeChildren; }
            set { includeChildren = value; }
        }

        /// <summary>Whether the inspector chamfers anew whenever a setting changes.</summary>
        public bool LivePreview
        {
            get { return livePreview; }
            set { livePreview = value; }
        }

        /// <summary>Whether the scene view shows what became of each hard edge.</summary>
        public bool ShowEdges
        {
            get { return showEdges; }
            set { showEdges = value; }
        }

#if UNITY_EDITOR
        [SerializeField, Tooltip("Settings that others share; they go before those below.")]
        internal ChamferPreset preset;

        /// <summary>Settings that others share, instead of <see cref="Settings"/>; null for none. Editor only.</summary>
        public ChamferPreset Preset
        {
            get { return preset; }
            set { preset = value; }
        }

        /// <summary>Those of the preset, if there is one.</summary>
        internal ChamferSettings Effective => (preset != null ? preset.settings : settings).Copy();

        // The originals are for the editor only: a player would carry every mesh twice.
        [SerializeField] internal List<ChamferedMesh> meshes = new List<ChamferedMesh>();

        /// <summary>Objects below that show the sources far away.</summary>
        [SerializeField, HideInInspector] internal List<GameObject> farObjects = new List<GameObject>();

        /// <summary>Whether the group that shows them was made for them.</summary>
        [SerializeField, HideInInspector] internal bool madeGroup;

        /// <summary>Whether the menu made it, so that it goes when its originals come back.</summary>
        [SerializeField, HideInInspector] internal bool isFromMenu;

        /// <summary>Whether some mesh is chamfered now.</summary>
        public bool IsApplied => meshes.Count > 0;

        private void Reset()
        {
            LeaveOutOfBuilds();
        }

        private void OnValidate()
        {
            LeaveOutOfBuilds();
        }

        /// <summary>Scenes are also cleared when they are built, but nothing is called for prefabs.</summary>
        internal void LeaveOutOfBuilds()
        {
            hideFlags |= HideFlags.DontSaveInBuild;
        }
#else
        /// <summary>Whether some mesh is chamfered now; players do not know.</summary>
        public bool IsApplied => false;
#endif
    }

#if UNITY_EDITOR
    /// <summary>One mesh that a modifier replaced.</summary>
    [Serializable]
    internal struct ChamferedMesh
    {
        /// <summary>A <c>MeshFilter</c> or <c>SkinnedMeshRenderer</c>.</summary>
        public Component holder;
        public Mesh original;
        public Mesh chamfered;

        /// <summary>What <see cref="chamfered"/> was made with.</summary>
        public ChamferSettings settings;

        /// <summary>
        /// Tells the original as it was then, the settings, and what stood around: objects with the same key share a
        /// mesh. Empty if that is not known.
        /// </summary>
        public string key;

        /// <summary>Tells the original as it was then; empty if that is not known.</summary>
        public string sourceKey;

        /// <summary>Where the mesh stood then, from the modifier; zeros if that is not known.</summary>
        public Matrix4x4 placed;

        /// <summary>How it was scaled in the world then; zeros if that is not known.</summary>
        public Vector3 worldScale;

        /// <summary>What became of its edges, in words.</summary>
        public string report;

        /// <summary>How many materials the renderer got because the chamfers have a submesh of their own.</summary>
        public int addedMaterials;
    }
#endif
}
