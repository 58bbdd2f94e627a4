using System;
using UnityEngine;

namespace Chamfer
{
    /// <summary>What a width is measured in.</summary>
    public enum WidthUnit
    {
        /// <summary>Units of the mesh, before its transform; with World Width, units of the world.</summary>
        MeshUnits = 0,
        /// <summary>Percent of the largest side of the mesh's box.</summary>
        PercentOfExtent = 1
    }

    /// <summary>How thoroughly a result is checked before it is given out.</summary>
    public enum VerifyMode
    {
        /// <summary>Nothing opens, flips or degenerates.</summary>
        Fast = 0,
        /// <summary>Also, no part cuts through itself where it did not before.</summary>
        Full = 1,
        /// <summary>
        /// Also, no light shows where none did before: the result is looked at from many sides, and edges around a
        /// place that lets light through are left hard. Takes a part of a second more.
        /// </summary>
        Seen = 2
    }

    /// <summary>Which submesh the new triangles go to, and so which material they have.</summary>
    public enum ChamferSubmesh
    {
        /// <summary>That of the face whose texture they continue.</summary>
        Owner = 0,
        /// <summary>A new one, behind all others.</summary>
        Own = 1,
        /// <summary>The one that <see cref="ChamferSettings.submesh"/> names.</summary>
        Given = 2
    }

    /// <summary>How to chamfer a mesh.</summary>
    [Serializable]
    public struct ChamferSettings
    {
        /// <summary>More segments than these nobody sees.</summary>
        public const int MostSegments = 32;

        [Tooltip("The distance between an old edge and the pulled one."), Min(0)]
        public float width;

        [Tooltip("What the width is measured in.")]
        public WidthUnit unit;

        [Tooltip("Full also keeps a part from cutting through itself. Seen also looks at the result: no light shows.")]
        public VerifyMode verify;

        [Tooltip("Which submesh, and so which material, the chamfers have.")]
        public ChamferSubmesh submeshMode;

        [Tooltip("With Given: the submesh that chamfers go to."), Min(0)]
        public int submesh;

        [Tooltip("How much of the breadth of each face stays between its chamfers, as a share; 0 for the usual fifth.")]
        [Range(0, 1)] public float leastBreadth;

        [Tooltip("How far widths are held to each other: 1 for one width on each edge; 0 for the usual half.")]
        [Range(0, 1)] public float evenness;

        [Tooltip("How many segments a chamfer has across: 1, or 0, is flat, more are round."), Range(0, MostSegments)]
        public int segments;

        [Tooltip("How a chamfer of several segments is bent: towards 0 flat, 0.5 a circle, 1 the old edge; 0 for the usual 0.5.")]
        [Range(0, 1)] public float profile;

        [Tooltip("Which edges are chamfered, what the width measures, and where it differs.")]
        public EdgeSettings edges;

        /// <summary>Half a percent of the extent, fully verified, in the submesh of the face beside it.</summary>
        public static ChamferSettings Default => new ChamferSettings
        {
            width = 0.5f,
            unit = WidthUnit.PercentOfExtent,
            verify = VerifyMode.Full
        };

        /// <summary>The same with a list of its own: a copy of a struct shares it.</summary>
        internal ChamferSettings Copy()
        {
            var copy = this;
            copy.edges.materials = edges.HasMaterials ? (MaterialFactor[])edges.materials.Clone() : null;
            return copy;
        }
    }
}
