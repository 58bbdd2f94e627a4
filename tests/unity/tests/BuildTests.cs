// What players get.
using System.Collections.Generic;
using Chamfer;
using ChamferEditor;
using UnityEditor.Build.Reporting;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class BuildTests
    {
        private static GameObject Built()
        {
            Mesh shared;
            var root = Scene.Hierarchy(out shared);
            new ChamferSelection(new[] { root }).Chamfer(ChamferSettings.Default);
            var scene = new UnityEngine.SceneManagement.Scene { name = "Built", roots = new List<GameObject> { root } };
            new BuildStripping().OnProcessScene(scene, new BuildReport());
            return root;
        }

        public static void Modifiers_are_taken_out_of_scenes()
        {
            var root = Built();
            Check.Equal(0, root.GetComponentsInChildren<ChamferModifier>(true).Length);
            Check.Equal(44 * 3, Scene.MeshOf(root).GetTriangles(0).Length);
        }

        public static void Playing_in_the_editor_keeps_them()
        {
            Application.isPlaying = true;
            try { Check.Equal(1, Built().GetComponentsInChildren<ChamferModifier>(true).Length); }
            finally { Application.isPlaying = false; }
        }

        /// Nothing is called when a prefab is built.
        public static void Modifiers_of_prefabs_are_marked()
        {
            var prefab = Scene.Holding(Shapes.Cube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/Built.prefab");
            new ChamferSelection(new[] { prefab }).Chamfer(ChamferSettings.Default);
            Check.That((prefab.GetComponent<ChamferModifier>().hideFlags & HideFlags.DontSaveInBuild) != 0, "marked");
            foreach (string message in new[] { "Reset", "OnValidate" })
            {
                var modifier = new GameObject("Item").AddComponent<ChamferModifier>();
                typeof(ChamferModifier).GetMethod(message, System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic).Invoke(modifier, null);
                Check.That((modifier.hideFlags & HideFlags.DontSaveInBuild) != 0, message);
            }
        }

        /// Bundles may hold whole files, and fail where something in them is marked as not to be built.
        public static void Records_are_the_editors()
        {
            var mesh = Shapes.Cube();
            UnityEditor.AssetDatabase.paths[mesh] = "Assets/Marked/Cube.asset";
            new ChamferSelection(new[] { mesh }).Chamfer(ChamferSettings.Default);
            var record = UnityEditor.AssetDatabase.LoadAssetAtPath<ChamferRecord>("Assets/Marked/Cube Chamfered.asset");
            Check.Equal(HideFlags.None, record.hideFlags);
            Check.Equal("Chamfer.Editor", typeof(ChamferRecord).Assembly.GetName().Name);
        }
    }
}
