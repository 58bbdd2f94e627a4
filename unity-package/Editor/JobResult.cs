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

        private readonly MeshArrays arrays;
        private readonly ArrayResult output;

        /// <param name="result">What the library made of the source.</param>
        /// <param name="settings">How it was chamfered.</param>
        /// <param name="key">Tells the source, the settings and what stood around.</param>
        internal JobResult(SceneResult result, ChamferSettings settings, string key)
        {
            arrays = result.Source;
            output = result.Output;
            output.Mesh.Name = result.Mesh.name + Suffix;
            Source = result.Mesh;
            Settings = settings;
            Key = key;
        }

        /// <summary>What somebody else made of the same source.</summary>
        internal JobResult(Mesh source, Mesh shared, ChamferSettings settings, string key)
        {
            Source = source;
            Mesh = shared;
            Settings = settings;
            Key = key;
        }

        /// <summary>Null for what somebody else made.</summary>
        internal ChamferReport Report => output.Report;

        internal Mesh Source { get; }

        internal ChamferSettings Settings { get; }

        internal string Key { get; }

        /// <summary>The mesh, once it is written.</summary>
        internal Mesh Mesh { get; private set; }

        /// <summary>Whether some edge was chamfered: otherwise the source does as well.</summary>
        internal bool HasChanged => Report.Chamfered + Report.Narrowed > 0;

        /// <summary>Makes the mesh, or replaces what another holds.</summary>
        internal void Write(Mesh overwritten = null)
        {
            if (overwritten == null) { Mesh = MeshWriter.Write(output.Mesh, Source); }
            else
            {
                MeshWriter.Overwrite(overwritten, output.Mesh, Source);
                Mesh = overwritten;
            }
            VerdictCache.Remember(Mesh, new MeshVerdicts(arrays, Report, Settings));
        }
    }
}
