using System;
using UnityEngine;

namespace Chamfer
{
    /// <summary>What a width measures.</summary>
    public enum WidthMode
    {
        /// <summary>From the old edge to the pulled one, within the face: the same at each edge.</summary>
        Offset = 0,
        /// <summary>Across the chamfer, from one pulled edge to the other.</summary>
        Chord = 1,
        /// <summary>From the old edge straight down to the chamfer.</summary>
        Depth = 2,
        /// <summary>Of the circle that touches both faces at the pulled edges.</summary>
        Radius = 3
    }

    /// <summary>Which way the faces of an edge meet.</summary>
    public enum EdgeConvexity
    {
        /// <summary>Either.</summary>
        Both = 0,
        /// <summary>As those of a cube.</summary>
        Convex = 1,
        /// <summary>As a wall and the floor of a room.</summary>
        Concave = 2
    }

    /// <summary>A channel of the vertex colours.</summary>
    public enum MaskChannel
    {
        /// <summary>No channel.</summary>
        None = 0,
        /// <summary>Red.</summary>
        Red = 1,
        /// <summary>Green.</summary>
        Green = 2,
        /// <summary>Blue.</summary>
        Blue = 3,
        /// <summary>Alpha.</summary>
        Alpha = 4
    }

    /// <summary>How wide the chamfers of one material are.</summary>
    [Serializable]
    public struct MaterialFactor
    {
        [Tooltip("The name of the material, as the renderer has it.")]
        public string material;

        [Tooltip("How many times the width its chamfers get; 0 leaves its edges as they are."), Min(0)]
        public float factor;
    }

    /// <summary>Which hard edges are chamfered, and how wide each. What is zero or empty asks for nothing special.</summary>
    [Serializable]
    public struct EdgeSettings
    {
        [Tooltip("What the width measures: Offset, from the old edge to the pulled one; Chord, across the chamfer; Depth, "
            + "from the old edge down to the chamfer; Radius, of the circle that touches both faces.")]
        public WidthMode widthMode;

        [Tooltip("Measure widths in the world: an object that is scaled gets chamfers as wide as one that is not. Percent "
            + "is then of the scaled mesh.")]
        public bool worldWidth;

        [Tooltip("Leave edges as they are whose faces meet at a smaller angle, in degrees: 0 is flat, 90 a cube's.")]
        [Range(0, 180)] public float minAngle;

        [Tooltip("Leave edges as they are whose faces meet at a larger angle, in degrees; 0 for no limit.")]
        [Range(0, 180)] public float maxAngle;

        [Tooltip("Convex: only edges as those of a cube. Concave: only those as between a wall and the floor.")]
        public EdgeConvexity convexity;

        [Tooltip("Normals count as one that differ by less, in degrees; 0 for the usual 1.")]
        [Range(0, 90)] public float hardAngle;

        [Tooltip("The channel of the vertex colours that says how wide chamfers are: 1 for the whole width, 0 for none.")]
        public MaskChannel mask;

        [Tooltip("How wide the chamfers of single materials are. Between two materials the smaller counts.")]
        public MaterialFactor[] materials;

        /// <summary>How many times the width the chamfers of a material get: the first that has its name says.</summary>
        internal float FactorOf(string material)
        {
            foreach (var one in materials ?? new MaterialFactor[0])
            {
                // A row that nobody has filled in yet is of no material, nor of one that is missing.
                if (one.material == material && !string.IsNullOrEmpty(material)) { return one.factor; }
            }
            return 1;
        }

        internal bool HasMaterials => materials != null && materials.Length > 0;
    }
}
