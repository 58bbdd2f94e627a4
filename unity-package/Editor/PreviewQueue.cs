using System.Collections.Generic;
using System.Linq;
using System.Threading.Tasks;
using Chamfer;
using UnityEditor;

namespace ChamferEditor
{
    /// <summary>
    /// Previews on another thread, one at a time, and each modifier's newest settings only: while a slider is dragged,
    /// the editor stays quick.
    /// </summary>
    internal static class PreviewQueue
    {
        private static readonly List<ChamferModifier> waiting = new List<ChamferModifier>();
        private static PreviewRun running;
        private static Task task;
        private static int group;

        /// <summary>What could not be chamfered, by modifier, until its next preview.</summary>
        internal static readonly Dictionary<ChamferModifier, IReadOnlyList<string>> Failures =
            new Dictionary<ChamferModifier, IReadOnlyList<string>>();

        /// <summary>Asks for a preview with the settings that the modifier has when its turn comes.</summary>
        internal static void Request(ChamferModifier modifier)
        {
            group = Undo.GetCurrentGroup();
            if (!waiting.Contains(modifier)) { waiting.Add(modifier); }
            EditorApplication.update -= Update;
            EditorApplication.update += Update;
            if (running == null) { Start(); }
        }

        /// <summary>Before scripts are loaded anew no thread may be at work.</summary>
        [InitializeOnLoadMethod]
        internal static void Listen()
        {
            AssemblyReloadEvents.beforeAssemblyReload -= Flush;
            AssemblyReloadEvents.beforeAssemblyReload += Flush;
        }

        /// <summary>Waits for all that was asked for.</summary>
        internal static void Flush()
        {
            while (running != null)
            {
                task.Wait();
                Update();
            }
        }

        /// <summary>At most one preview comes into the scene before the next picture is drawn.</summary>
        private static void Update()
        {
            if (running == null || !task.IsCompleted) { return; }
            if (task.IsFaulted) { UnityEngine.Debug.LogException(task.Exception); }
            Finish();
            Start();
            if (running == null) { EditorApplication.update -= Update; }
        }

        private static void Start()
        {
            waiting.RemoveAll(modifier => modifier == null);
            while (running == null && waiting.Count > 0)
            {
                running = new PreviewRun(waiting[0]);
                waiting.RemoveAt(0);
                // What the last preview made for one object, a hundred others take at once.
                if (running.IsDone) { Finish(); }
                else { task = Task.Run((System.Action)running.Work); }
            }
        }

        private static void Finish()
        {
            var done = running;
            running = null;
            done.Finish();
            // Letting go of the slider begins a new undo step, and the last preview may come after that.
            if (Undo.GetCurrentGroup() == group + 1) { Undo.CollapseUndoOperations(group); }
            foreach (var gone in Failures.Keys.Where(modifier => modifier == null).ToList()) { Failures.Remove(gone); }
            Failures[done.Modifier] = done.Failures;
            SceneView.RepaintAll();
        }
    }
}
