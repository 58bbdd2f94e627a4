using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Lies in a file beside meshes that were chamfered: what they were made of. Its class is the editor's, so players do
    /// not get it. It has no flags: Unity does not find what is hidden by its type, and bundles that hold what is marked
    /// as not to be built fail.
    /// </summary>
    internal sealed class ChamferRecord : ScriptableObject
    {
        /// <summary>None in a model: its meshes were replaced when it was imported.</summary>
        [SerializeField] internal Mesh source;

        [SerializeField] internal ChamferSettings settings;

        /// <summary>Tells the source as it was then.</summary>
        [SerializeField] internal string sourceKey;

        /// <summary>Whether the package made the file by itself: what is saved by hand is the user's.</summary>
        [SerializeField] internal bool isManaged;

        /// <summary>The prefab whose stage the mesh was made in, as its GUID; empty where there are others, too.</summary>
        [SerializeField] internal string owner = "";

        /// <summary>How the source was scaled in the world; zeros if that is not known.</summary>
        [SerializeField] internal Vector3 worldScale;

        /// <summary>The names of its materials, where the settings know some.</summary>
        [SerializeField] internal string[] materials = new string[0];

        /// <summary>In a model: what came of it, in words.</summary>
        [SerializeField] internal string report;

        /// <summary>In a model: how many triangles its file has, and the largest side of its largest mesh.</summary>
        [SerializeField] internal int triangles;
        [SerializeField] internal float size;

        /// <summary>In a model: what could not be chamfered.</summary>
        [SerializeField] internal string[] failures = new string[0];

        internal static ChamferRecord Make(Mesh source, ChamferSettings settings)
        {
            var record = CreateInstance<ChamferRecord>();
            record.name = "Chamfer Record";
            record.settings = settings.Copy();
            record.source = source;
            record.sourceKey = source != null ? MeshKeys.Of(source) : MeshKeys.Unknown;
            return record;
        }

        /// <summary>Of a mesh that was chamfered where it stands, so that it can be chamfered again without that.</summary>
        internal static ChamferRecord Make(ChamferedMesh entry)
        {
            var record = Make(entry.original, entry.settings);
            record.worldScale = entry.worldScale;
            var renderer = entry.holder != null ? MeshSlot.Of(entry.holder).Renderer : null;
            bool hasMaterials = renderer != null && entry.settings.edges.HasMaterials;
            if (hasMaterials) { record.materials = SceneArrays.NamesOf(renderer.sharedMaterials); }
            return record;
        }
    }
}
