// The editor, as far as the package uses it. Calls are recorded for tests to look at.
using UnityEngine;

namespace UnityEditor
{
    public static class MeshUtility
    {
        public static Mesh.MeshDataArray AcquireReadOnlyMeshData(Mesh mesh) { return Mesh.Snapshot(mesh); }
    }
}
