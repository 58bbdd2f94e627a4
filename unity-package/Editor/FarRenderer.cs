using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Draws a source as its chamfered mesh is drawn.</summary>
    internal static class FarRenderer
    {
        internal static Renderer Make(GameObject item, ChamferedMesh entry)
        {
            var skinned = entry.holder as SkinnedMeshRenderer;
            if (skinned == null) { item.AddComponent<MeshFilter>().sharedMesh = entry.original; }
            var renderer = skinned != null ? Copy(skinned, item.AddComponent<SkinnedMeshRenderer>())
                : Copy(entry.holder.GetComponent<Renderer>(), item.AddComponent<MeshRenderer>());
            if (skinned != null) { ((SkinnedMeshRenderer)renderer).sharedMesh = entry.original; }
            // The chamfers may have a submesh, and so a material, of their own.
            var materials = renderer.sharedMaterials;
            System.Array.Resize(ref materials, System.Math.Max(0, materials.Length - entry.addedMaterials));
            renderer.sharedMaterials = materials;
            return renderer;
        }

        private static Renderer Copy(Renderer from, Renderer to)
        {
            EditorUtility.CopySerialized(from, to);
            return to;
        }
    }
}
