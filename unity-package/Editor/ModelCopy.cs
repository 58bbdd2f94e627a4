using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Chamfered copies of models whose importers do not let other packages change what they make, or that shall stay
    /// as they are: prefab variants, so that all else follows the model.
    /// </summary>
    internal static class ModelCopy
    {
        /// <summary>Makes a copy, or does that of an earlier time again; false if the user cancelled.</summary>
        internal static bool Make(GameObject model, ChamferSettings settings, JobSummary summary)
        {
            var variant = Earlier(model);
            bool isNew = variant == null;
            if (isNew) { variant = Create(model); }
            bool isDone = new ChamferSelection(new Object[] { variant }).Chamfer(settings, summary);
            if (!isDone && isNew) { AssetDatabase.DeleteAsset(AssetDatabase.GetAssetPath(variant)); }
            return isDone;
        }

        /// <summary>Whether an object is the whole of a file that was imported.</summary>
        internal static bool IsModel(Object item)
        {
            var root = item as GameObject;
            string path = root != null ? AssetDatabase.GetAssetPath(root) : "";
            bool isPrefab = path.EndsWith(".prefab", System.StringComparison.OrdinalIgnoreCase);
            return path.Length > 0 && !isPrefab && AssetDatabase.IsMainAsset(root) && MeshSlot.In(root, true).Count > 0;
        }

        private static GameObject Earlier(GameObject model)
        {
            var earlier = AssetDatabase.LoadAssetAtPath<GameObject>(PathOf(model));
            return earlier != null && PrefabUtility.GetCorrespondingObjectFromSource(earlier) == model ? earlier : null;
        }

        private static GameObject Create(GameObject model)
        {
            var instance = (GameObject)PrefabUtility.InstantiatePrefab(model);
            try { return PrefabUtility.SaveAsPrefabAsset(instance, AssetDatabase.GenerateUniqueAssetPath(PathOf(model))); }
            finally { Object.DestroyImmediate(instance); }
        }

        private static string PathOf(GameObject model)
        {
            string path = AssetDatabase.GetAssetPath(model);
            string name = System.IO.Path.GetFileNameWithoutExtension(path);
            return AssetNames.Folder(path) + "/" + name + JobResult.Suffix + ".prefab";
        }
    }
}
