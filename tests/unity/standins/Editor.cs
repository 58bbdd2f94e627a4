// The editor, as far as the package uses it. What it is asked to do is recorded for tests to look at.
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public enum ModelImporterMeshCompression { Off, Low, Medium, High }

    public static class MeshUtility
    {
        public static Mesh.MeshDataArray AcquireReadOnlyMeshData(Mesh mesh) { return Mesh.Snapshot(mesh); }
        public static ModelImporterMeshCompression GetMeshCompression(Mesh mesh) { return mesh.compression; }
        public static void SetMeshCompression(Mesh mesh, ModelImporterMeshCompression value) { mesh.compression = value; }
    }

    public static class MeshLodUtility
    {
        public static void GenerateMeshLods(Mesh mesh, int meshLodLimit = -1)
        {
            mesh.lodCount = meshLodLimit + 1;
            mesh.lodsOf = mesh.version;
        }
    }

    public static class EditorUtility
    {
        public static readonly HashSet<Object> persistent = new HashSet<Object>();
        public static readonly HashSet<Object> dirty = new HashSet<Object>();
        public static Func<float, bool> onProgress = share => false;
        public static bool barShown;
        public static bool IsPersistent(Object target) { return persistent.Contains(target) || AssetDatabase.Contains(target); }
        public static void SetDirty(Object target) { dirty.Add(target); }

        /// Of renderers: what draws.
        public static void CopySerialized(Object from, Object to)
        {
            ((Renderer)to).sharedMaterials = ((Renderer)from).sharedMaterials;
            if (to is SkinnedMeshRenderer) { ((SkinnedMeshRenderer)to).bones = ((SkinnedMeshRenderer)from).bones; }
        }

        public static int GetDirtyCount(Object target) { return target is Mesh ? ((Mesh)target).version : 0; }
        public static void ClearProgressBar() { barShown = false; }
        /// The folder that the user chooses; none if the dialogue is cancelled.
        public static string chosen = "";
        public static readonly List<string> dialogs = new List<string>();

        public static string SaveFolderPanel(string title, string folder, string name)
        {
            GUILayout.broken = true;
            return chosen;
        }

        public static bool DisplayDialog(string title, string message, string ok)
        {
            GUILayout.broken = true;
            dialogs.Add(message);
            return true;
        }

        public static bool DisplayCancelableProgressBar(string title, string info, float progress)
        {
            barShown = true;
            GUILayout.broken = true;
            return onProgress(progress);
        }
    }

    public static class Selection
    {
        public static Object[] objects = new Object[0];
        public static System.Action selectionChanged;
    }

    public static class EditorApplication
    {
        public delegate void CallbackFunction();
        public static int exitCode = -1;
        public static CallbackFunction delayCall, update;
        public static Action projectChanged;
        public static void Exit(int code) { exitCode = code; }

        /// What happens when the editor has nothing else to do.
        public static void Idle()
        {
            while (delayCall != null) { var calls = delayCall; delayCall = null; calls(); }
            if (update != null) { update(); }
        }
    }

    public static class AssemblyReloadEvents
    {
        public delegate void AssemblyReloadCallback();
        public static event AssemblyReloadCallback beforeAssemblyReload;
        public static void Reload() { if (beforeAssemblyReload != null) { beforeAssemblyReload(); } }
    }

    public class MenuCommand { public Object context; }

    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public class MenuItem : Attribute
    {
        public readonly string path;
        public readonly bool isValidator;
        public MenuItem(string path, bool isValidator) { this.path = path; this.isValidator = isValidator; }
        public MenuItem(string path, bool isValidator, int priority) : this(path, isValidator) { }
    }

    [AttributeUsage(AttributeTargets.Method)]
    public class InitializeOnLoadMethodAttribute : Attribute { }
}

namespace UnityEditorInternal
{
    public static class InternalEditorUtility
    {
        /// What is in files that are no assets.
        public static readonly Dictionary<string, Object[]> files = new Dictionary<string, Object[]>();
        public static int saves;

        public static Object[] LoadSerializedFileAndForget(string path)
        {
            Object[] saved;
            if (!files.TryGetValue(path, out saved)) { return new Object[0]; }
            return saved.Select(Copies.Of).ToArray();
        }

        public static void SaveToSerializedFileAndForget(Object[] objects, string path, bool allowTextSerialization)
        {
            saves++;
            files[path] = objects.Select(Copies.Of).ToArray();
        }
    }

    internal static class Copies
    {
        internal static Object Of(Object original)
        {
            var copy = Object.Instantiate(original);
            copy.hideFlags = HideFlags.None;
            Duplicates.Redirect(copy, new Dictionary<object, object>());
            return copy;
        }
    }
}

namespace UnityEditor.Build
{
    public interface IOrderedCallback { int callbackOrder { get; } }

    public interface IProcessSceneWithReport : IOrderedCallback
    {
        void OnProcessScene(UnityEngine.SceneManagement.Scene scene, Reporting.BuildReport report);
    }
}

namespace UnityEditor.Build.Reporting
{
    public class BuildReport : Object { }
}
