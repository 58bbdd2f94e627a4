using Chamfer;
using UnityEditor.Build;
using UnityEditor.Build.Reporting;
using UnityEngine;
using UnityEngine.SceneManagement;

namespace ChamferEditor
{
    /// <summary>Takes modifiers out of scenes that are built: players have the chamfered meshes only.</summary>
    internal sealed class BuildStripping : IProcessSceneWithReport
    {
        public int callbackOrder => 0;

        public void OnProcessScene(Scene scene, BuildReport report)
        {
            // Scenes are also processed when the game is played in the editor, where nothing is gained.
            if (Application.isPlaying) { return; }
            foreach (var root in scene.GetRootGameObjects())
            {
                var modifiers = root.GetComponentsInChildren<ChamferModifier>(true);
                foreach (var modifier in modifiers) { Object.DestroyImmediate(modifier); }
            }
        }
    }
}
