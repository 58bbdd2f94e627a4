using UnityEngine;

namespace Chamfer
{
    /// <summary>A mesh that stands somewhere in a scene.</summary>
    public struct PlacedMesh
    {
        /// <summary>Makes one.</summary>
        public PlacedMesh(Mesh mesh, Matrix4x4 transform) : this()
        {
            Mesh = mesh;
            Transform = transform;
            WorldScale = new Vector3(Length(transform, 0), Length(transform, 4), Length(transform, 8));
        }

        /// <summary>The mesh. It may stand in several places.</summary>
        public Mesh Mesh { get; }

        /// <summary>
        /// From the mesh to the scene, such as <c>root.worldToLocalMatrix * transform.localToWorldMatrix</c>. It may
        /// mirror.
        /// </summary>
        public Matrix4x4 Transform { get; }

        /// <summary>
        /// The scale in which <see cref="EdgeSettings.worldWidth"/> measures, such as <c>transform.lossyScale</c>. At
        /// first that of <see cref="Transform"/>. Of a mesh in several places, the first place counts.
        /// </summary>
        public Vector3 WorldScale { get; set; }

        /// <summary>
        /// Those of the renderer, one for each submesh, for <see cref="EdgeSettings.materials"/>; null for none. Of a
        /// mesh in several places, the first place counts.
        /// </summary>
        public Material[] Materials { get; set; }

        /// <summary>Those of <see cref="Materials"/>, where the materials themselves are not known.</summary>
        internal string[] MaterialNames { get; set; }

        private static float Length(Matrix4x4 matrix, int first)
        {
            return new Vector3(matrix[first], matrix[first + 1], matrix[first + 2]).magnitude;
        }
    }
}
