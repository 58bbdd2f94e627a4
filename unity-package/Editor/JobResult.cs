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

        private readonly ArrayResult output;

        /// <param name="result">What the library made of the source.</param>
        /// <param name="settings">How it was chamfered.</param>
        /// <param name="key">Tells the source, the settings and what stood around.</param>
        internal JobResult(SceneResult result, ChamferSettings settings, string key)
        {
            output = result.Output;
            output.Mesh.Name = result.Mesh.name + Suffix;
            Source = result.Mesh;
            Settings = settings.Copy();
            Key = key;
            Text = ReportText.Of(result.Output.Report);
            // A preview keeps them only if somebody looks at them.
            bool hasVerdicts = Report.Verdicts.Count == Report.HardEdges;
            if (hasVerdicts) { VerdictCache.Remember(key, new MeshVerdicts(result.Source, Report, settings)); }
        }

        /// <summary>What somebody else made of the same source.</summary>
        internal JobResult(ChamferedMesh shared)
        {
            Source = shared.original;
            Mesh = shared.chamfered;
            Settings = shared.settings.Copy();
            Key = shared.key;
            Text = shared.report;
        }

        /// <summary>Null for what somebody else made.</summary>
        internal ChamferReport Report => output.Report;

        internal Mesh Source { get; }

        internal ChamferSettings Settings { get; }

        internal string Key { get; }

        /// <summary>The report in words, counted once.</summary>
        internal string Text { get; }

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
        }

        /// <summary>Replaces what a mesh holds that was made of the same source a moment ago.</summary>
        internal void Renew(Mesh mesh)
        {
            MeshWriter.Renew(mesh, output.Mesh, Source);
            Mesh = mesh;
        }
    }
}
