using Chamfer;
using Chamfer.Streams;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What a job made of one mesh; it becomes a mesh when it is written.</summary>
    internal sealed class JobResult
    {
        /// <summary>What the names of chamfered meshes end with.</summary>
        internal const string Suffix = " Chamfered";

        private readonly Vector3[] positions;
        private readonly ChamferSettings settings;
        private readonly ArrayResult output;

        /// <param name="positions">Those of the source.</param>
        /// <param name="settings">How it was chamfered.</param>
        /// <param name="output">What the library made of it.</param>
        internal JobResult(Vector3[] positions, ChamferSettings settings, ArrayResult output)
        {
            this.positions = positions;
            this.settings = settings;
            this.output = output;
        }

        internal ChamferReport Report => output.Report;

        internal string Name => output.Mesh.Name;

        /// <summary>The mesh, once it is written.</summary>
        internal Mesh Mesh { get; private set; }

        /// <summary>Makes the mesh, or replaces what another holds.</summary>
        internal void Write(Mesh overwritten = null)
        {
            if (overwritten == null) { Mesh = MeshWriter.Write(output.Mesh); }
            else
            {
                MeshWriter.Overwrite(overwritten, output.Mesh);
                Mesh = overwritten;
            }
            VerdictCache.Remember(Mesh, new MeshVerdicts(positions, Report, settings));
        }
    }
}
