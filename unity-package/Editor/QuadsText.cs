using UnityEngine;

namespace ChamferEditor
{
    /// <summary>What is said of meshes whose faces have four corners.</summary>
    internal static class QuadsText
    {
        internal static string Of(Mesh mesh)
        {
            return "The mesh '" + mesh.name + "' has faces of four corners, which stay as they are: switch off Keep Quads "
                + "in the import settings of its model";
        }
    }
}
