using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Who uses a mesh. A modifier may only write or destroy what nobody else uses: objects are duplicated together
    /// with their meshes.
    /// </summary>
    internal static class MeshUsers
    {
        /// <summary>Whether someone but these holders uses a mesh: an object, a collider or another modifier.</summary>
        internal static bool HasOthers(Mesh mesh, HashSet<Component> holders)
        {
            return Holders(mesh).Any(other => !IsOneOf(other, holders));
        }

        /// <summary>Whether a prefab or scene but one uses a file: copies of prefabs use what the prefab uses.</summary>
        internal static bool IsInOtherFiles(string file, string but)
        {
            var guids = AssetDatabase.FindAssets("t:Prefab").Concat(AssetDatabase.FindAssets("t:Scene"));
            var paths = guids.Select(guid => AssetDatabase.GUIDToAssetPath(guid)).Where(path => path != but);
            return paths.Any(path => AssetDatabase.GetDependencies(path, false).Contains(file));
        }

        private static IEnumerable<Component> Holders(Mesh mesh)
        {
            foreach (var filter in Resources.FindObjectsOfTypeAll<MeshFilter>())
            {
                if (filter.sharedMesh == mesh) { yield return filter; }
            }
            foreach (var skinned in Resources.FindObjectsOfTypeAll<SkinnedMeshRenderer>())
            {
                if (skinned.sharedMesh == mesh) { yield return skinned; }
            }
            foreach (var collider in Resources.FindObjectsOfTypeAll<MeshCollider>())
            {
                if (collider.sharedMesh == mesh) { yield return collider; }
            }
            foreach (var modifier in Resources.FindObjectsOfTypeAll<ChamferModifier>())
            {
                foreach (var entry in modifier.meshes)
                {
                    if (entry.chamfered == mesh && entry.holder != null) { yield return entry.holder; }
                }
            }
        }

        private static bool IsOneOf(Component other, HashSet<Component> holders)
        {
            return Follows(other, holders) || IsSavedTwin(other, holders);
        }

        /// <summary>Instances of a prefab have what the prefab has, unless they say otherwise.</summary>
        internal static bool Follows(Component other, HashSet<Component> holders)
        {
            for (var source = other; source != null; source = PrefabUtility.GetCorrespondingObjectFromSource(source))
            {
                if (holders.Contains(source)) { return true; }
            }
            return false;
        }

        /// <summary>What is open in a stage is also in the file, which follows when it is saved.</summary>
        private static bool IsSavedTwin(Component other, HashSet<Component> holders)
        {
            string path = AssetDatabase.GetAssetPath(other);
            return path.Length > 0 && holders.Any(holder => SlotEditing.StagePath(holder) == path);
        }
    }
}
