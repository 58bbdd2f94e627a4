using UnityEngine;

namespace Chamfer
{
    /// <summary>A mesh that stands somewhere in a scene.</summary>
    public struct PlacedMesh
    {
        /// <summary>Makes one.</summary>
        public PlacedMesh(Mesh mesh, Matrix4x4 transform)
        {
            Mesh = mesh;
            Transform = transform;
        }

        /// <summary>The mesh. It may stand in several places.</summary>
        public Mesh Mesh { get; }

        /// <summary>
        /// From the mesh to the scene, such as <c>root.worldToLocalMatrix * transform.localToWorldMatrix</c>. It may
        /// mirror.
        /// </summary>
        public Matrix4x4 Transform { get; }
    }
}
