using UnityEngine;

namespace Chamfer
{
    /// <summary>A new mesh, and what became of the edges of the old one.</summary>
    public sealed class ChamferResult
    {
        internal ChamferResult(Mesh mesh, ChamferReport report)
        {
            Mesh = mesh;
            Report = report;
        }

        /// <summary>The chamfered mesh. It belongs to the caller.</summary>
        public Mesh Mesh { get; }

        /// <summary>What became of the edges.</summary>
        public ChamferReport Report { get; }
    }
}
