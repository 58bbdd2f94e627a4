namespace Chamfer.Streams
{
    /// <summary>Checks the settings that only this side of the native border knows to be wrong.</summary>
    internal static class SettingsCheck
    {
        internal static void Require(MeshArrays mesh, ChamferSettings settings)
        {
            if (settings.submeshMode != ChamferSubmesh.Given) { return; }
            bool exists = settings.submesh >= 0 && settings.submesh < mesh.Submeshes.Length;
            if (exists && mesh.Submeshes[settings.submesh].IsTriangles) { return; }
            throw new InvalidSettingsException("Chamfers cannot go to submesh " + settings.submesh + " of '" + mesh.Name
                + "': choose one of its submeshes of triangles (it has " + mesh.Submeshes.Length + " submeshes)");
        }
    }
}
