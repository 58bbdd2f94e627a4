using System;
using UnityEngine;

namespace Chamfer.Streams
{
    /// <summary>Checks the settings that only this side of the native border knows to be wrong.</summary>
    internal static class SettingsCheck
    {
        /// <summary>As the library's: what keeps less of its volume is flat in single precision.</summary>
        private const double LeastVolume = 1e-6;

        internal static void Require(MeshArrays mesh, ChamferSettings settings)
        {
            RequireSubmesh(mesh, settings);
            RequireMaterials(settings.edges.materials ?? new MaterialFactor[0]);
        }

        private static void RequireSubmesh(MeshArrays mesh, ChamferSettings settings)
        {
            if (settings.submeshMode != ChamferSubmesh.Given) { return; }
            bool exists = settings.submesh >= 0 && settings.submesh < mesh.Submeshes.Length;
            if (exists && mesh.Submeshes[settings.submesh].IsTriangles) { return; }
            throw new InvalidSettingsException("Chamfers cannot go to submesh " + settings.submesh + " of '" + mesh.Name
                + "': choose one of its submeshes of triangles (it has " + mesh.Submeshes.Length + " submeshes)");
        }

        private static void RequireMaterials(MaterialFactor[] materials)
        {
            foreach (var one in materials)
            {
                if (one.factor >= 0 && !float.IsInfinity(one.factor)) { continue; }
                throw new InvalidSettingsException("The factor of the material '" + one.material + "' is " + one.factor
                    + ": give a finite number of at least 0");
            }
        }

        /// <summary>Whether widths can be measured where a mesh stands.</summary>
        /// <param name="scale">Not negative; zeros for the mesh as it is.</param>
        internal static void RequireScale(MeshArrays mesh, Vector3 scale)
        {
            double longest = Math.Max(scale.x, Math.Max(scale.y, scale.z));
            if (longest == 0) { return; }
            bool isSound = (double)scale.x * scale.y * scale.z > longest * longest * longest * LeastVolume;
            if (isSound && !double.IsInfinity(longest)) { return; }
            throw new InvalidSettingsException("World Width cannot measure '" + mesh.Name + "', which is scaled flat: "
                + "its scale is " + scale + ". Make the flat axis larger, or switch World Width off");
        }
    }
}
