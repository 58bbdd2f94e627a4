// Unity's objects and components, as far as the package uses them.
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine.SceneManagement;

namespace UnityEngine
{
    public class Object
    {
        /// What was made, where a test asks for it: Unity keeps what nobody uses any more, the collector here does not.
        public static List<Object> everMade;
        public string name { get; set; }
        public HideFlags hideFlags { get; set; }
        public bool destroyed;
        public Object() { if (everMade != null) { everMade.Add(this); } }
        public static void DestroyImmediate(Object target) { target.destroyed = true; }
        public static void DestroyImmediate(Object target, bool allowAssets) { target.destroyed = true; }
        public static void Destroy(Object target) { target.destroyed = true; }

        public static T Instantiate<T>(T original) where T : Object
        {
            var copy = (T)original.MemberwiseClone();
            if (everMade != null) { everMade.Add(copy); }
            return copy;
        }

        public static bool operator ==(Object a, Object b)
        {
            bool noA = ReferenceEquals(a, null) || a.destroyed, noB = ReferenceEquals(b, null) || b.destroyed;
            return noA || noB ? noA && noB : ReferenceEquals(a, b);
        }
        public static bool operator !=(Object a, Object b) { return !(a == b); }
        public static implicit operator bool(Object target) { return target != null; }
        public override bool Equals(object other) { return ReferenceEquals(this, other); }
        public override int GetHashCode() { return base.GetHashCode(); }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public class TooltipAttribute : Attribute { public TooltipAttribute(string text) { } }

    [AttributeUsage(AttributeTargets.Field)]
    public class SerializeField : Attribute { }

    [AttributeUsage(AttributeTargets.Field)]
    public class RangeAttribute : Attribute { public RangeAttribute(float min, float max) { } }

    public class CreateAssetMenuAttribute : Attribute
    {
        public string fileName { get; set; }
        public string menuName { get; set; }
    }

    public class IconAttribute : Attribute { public IconAttribute(string path) { } }
    public class HelpURLAttribute : Attribute { public readonly string url; public HelpURLAttribute(string url) { this.url = url; } }

    [AttributeUsage(AttributeTargets.Field)]
    public class MinAttribute : Attribute { public MinAttribute(float min) { } }

    /// Unity's kind of task: it can be awaited once.
    public sealed class Awaitable<T>
    {
        internal readonly System.Threading.Tasks.TaskCompletionSource<T> source = new System.Threading.Tasks.TaskCompletionSource<T>();
        public System.Runtime.CompilerServices.TaskAwaiter<T> GetAwaiter() { return source.Task.GetAwaiter(); }
    }

    public sealed class AwaitableCompletionSource<T>
    {
        private readonly Awaitable<T> awaitable = new Awaitable<T>();
        public Awaitable<T> Awaitable { get { return awaitable; } }
        public void SetResult(T value) { awaitable.source.SetResult(value); }
        public void SetCanceled() { awaitable.source.SetCanceled(); }
        public void SetException(Exception exception) { awaitable.source.SetException(exception); }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public class HideInInspector : Attribute { }

    public static class Mathf
    {
        public static float Abs(float value) { return Math.Abs(value); }
        public static float Max(float a, float b) { return Math.Max(a, b); }
        public static int Max(int a, int b) { return Math.Max(a, b); }
        public static float Clamp(float value, float least, float most) { return Math.Max(least, Math.Min(most, value)); }
    }

    public class DisallowMultipleComponent : Attribute { }

    public class AddComponentMenu : Attribute { public AddComponentMenu(string path) { } }

    [Flags]
    public enum HideFlags { None = 0, HideInHierarchy = 1, HideInInspector = 2, DontSaveInEditor = 4, NotEditable = 8, DontSaveInBuild = 16, HideAndDontSave = 61 }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject, new() { return new T(); }
    }

    public static class Resources
    {
        internal static readonly List<WeakReference> components = new List<WeakReference>();

        public static T[] FindObjectsOfTypeAll<T>() where T : Object
        {
            components.RemoveAll(one => !one.IsAlive);
            return components.Select(one => one.Target).OfType<T>().Where(one => one != null).ToArray();
        }
    }

    public class Transform : Component
    {
        public Vector3 localPosition { get; set; }
        public Vector3 localScale { get; set; }
        public Quaternion localRotation { get; set; }
        public Transform parent { get; internal set; }
        public Matrix4x4 worldToLocalMatrix { get { return localToWorldMatrix.inverse; } }
        public void SetParent(Transform other, bool worldPositionStays)
        {
            if (UnityEditor.EditorUtility.IsPersistent(other.gameObject)) { throw new InvalidOperationException("Setting the parent of a transform which resides in a Prefab Asset is disabled"); }
            other.gameObject.children.Add(gameObject);
        }

        public Transform root { get { return parent != null ? parent.root : this; } }
        public Transform() { localScale = new Vector3(1, 1, 1); }

        public Vector3 lossyScale
        {
            get
            {
                var above = parent != null ? parent.lossyScale : new Vector3(1, 1, 1);
                return new Vector3(above.x * localScale.x, above.y * localScale.y, above.z * localScale.z);
            }
        }

        public Matrix4x4 localToWorldMatrix
        {
            get
            {
                var local = Matrix4x4.TRS(localPosition, localRotation, localScale);
                return parent != null ? parent.localToWorldMatrix * local : local;
            }
        }
    }

    public class Component : Object
    {
        /// What this is an instance of, in the prefab that its object was made from.
        public Component source;
        /// Whether the prefab's file, or the scene's, knows what was set here.
        public bool recorded;
        public GameObject gameObject { get; internal set; }
        public Transform transform { get { return gameObject.transform; } }
        public Component() { Resources.components.Add(new WeakReference(this)); }

        public T GetComponent<T>() { return gameObject.GetComponent<T>(); }
        public T[] GetComponentsInChildren<T>() { return gameObject.GetComponentsInChildren<T>(false); }
        public T[] GetComponentsInChildren<T>(bool includeInactive) { return gameObject.GetComponentsInChildren<T>(includeInactive); }

        /// From the object itself up.
        public T[] GetComponentsInParent<T>(bool includeInactive)
        {
            var found = new List<T>();
            for (var above = transform; above != null; above = above.parent) { found.AddRange(above.gameObject.GetComponents<T>()); }
            return found.ToArray();
        }
    }

    public class MonoBehaviour : Component { }
    public class Material : Object { }

    public class MeshFilter : Component
    {
        private Mesh mesh;
        private bool set;
        public Mesh sharedMesh
        {
            get { return set || source == null ? mesh : ((MeshFilter)source).sharedMesh; }
            set { mesh = value; set = true; }
        }
        /// What Unity does when the prefab changes: what nobody recorded is lost.
        public void Merge() { if (!recorded) { set = false; } }
    }

    public enum PrimitiveType { Sphere, Capsule, Cylinder, Cube, Plane, Quad }

    public struct LOD
    {
        public float screenRelativeTransitionHeight;
        public Renderer[] renderers;
        public LOD(float height, Renderer[] renderers) { screenRelativeTransitionHeight = height; this.renderers = renderers; }
    }

    public class LODGroup : Component
    {
        private LOD[] levels = new LOD[0];
        public LOD[] GetLODs() { return (LOD[])levels.Clone(); }
        public void RecalculateBounds() { }

        public void SetLODs(LOD[] lods)
        {
            for (int i = 1; i < lods.Length; i++)
            {
                if (lods[i].screenRelativeTransitionHeight >= lods[i - 1].screenRelativeTransitionHeight) { throw new ArgumentException("heights must fall"); }
            }
            levels = (LOD[])lods.Clone();
        }
    }

    public class MeshCollider : Component { public Mesh sharedMesh { get; set; } }
    public class MeshRenderer : Renderer { }

    public class SkinnedMeshRenderer : Renderer
    {
        public Mesh sharedMesh { get; set; }
        private Transform[] boneValues = new Transform[0];
        public Transform[] bones { get { return boneValues; } set { boneValues = value; } }
    }

    public class Renderer : Component
    {
        private Material[] materials = new Material[0];
        public Material[] sharedMaterials { get { return (Material[])materials.Clone(); } set { materials = (Material[])value.Clone(); } }
    }

    public sealed class Children : System.Collections.ObjectModel.Collection<GameObject>
    {
        private readonly Transform parent;
        internal Children(Transform parent) { this.parent = parent; }

        protected override void InsertItem(int index, GameObject child)
        {
            base.InsertItem(index, child);
            child.transform.parent = parent;
        }
    }

    public class GameObject : Object
    {
        private readonly List<Component> components = new List<Component>();
        private Scene ownScene;
        public int layer;
        /// What this is an instance of.
        public GameObject source;
        public readonly Children children;
        public Transform transform { get; private set; }

        public GameObject(string name)
        {
            this.name = name;
            transform = AddComponent<Transform>();
            children = new Children(transform);
            ownScene = SceneManager.active;
        }

        /// With a mesh that has neither UVs nor tangents here.
        public static GameObject CreatePrimitive(PrimitiveType type)
        {
            var made = new GameObject(type.ToString());
            made.AddComponent<MeshFilter>().sharedMesh = Primitive(type);
            made.AddComponent<MeshRenderer>().sharedMaterials = new[] { new Material() };
            return made;
        }

        /// That of the package's tests; set by them.
        public static Func<PrimitiveType, Mesh> Primitive = type => null;

        /// That of the root.
        public Scene scene
        {
            get { return transform.parent != null ? transform.parent.gameObject.scene : ownScene; }
            set { ownScene = value; }
        }

        public T AddComponent<T>() where T : Component, new()
        {
            var component = new T { name = name };
            Attach(component);
            return component;
        }

        internal void Attach(Component component)
        {
            component.gameObject = this;
            components.Add(component);
        }

        public T GetComponent<T>()
        {
            var found = GetComponents<T>();
            return found.Length > 0 ? found[0] : default(T);
        }

        public T[] GetComponents<T>()
        {
            var found = new List<T>();
            foreach (object component in components) { if (component is T && !((Object)component).destroyed) { found.Add((T)component); } }
            return found.ToArray();
        }

        public T[] GetComponentsInChildren<T>(bool includeInactive)
        {
            var found = new List<T>(GetComponents<T>());
            foreach (var child in children) { if (!child.destroyed) { found.AddRange(child.GetComponentsInChildren<T>(includeInactive)); } }
            return found.ToArray();
        }

        /// A copy of it and all below, whose references to each other are those of the copies.
        public GameObject Duplicate(Action<Component, Component> linked = null)
        {
            var pairs = new Dictionary<object, object>();
            var copy = DuplicateObjects(pairs);
            foreach (var pair in pairs.Where(pair => pair.Key is Component).ToList())
            {
                Duplicates.Redirect(pair.Value, pairs);
                if (linked != null) { linked((Component)pair.Key, (Component)pair.Value); }
            }
            return copy;
        }

        private GameObject DuplicateObjects(Dictionary<object, object> pairs)
        {
            var copy = new GameObject(name) { ownScene = ownScene };
            pairs[this] = copy;
            pairs[transform] = copy.transform;
            copy.transform.localPosition = transform.localPosition;
            copy.transform.localScale = transform.localScale;
            foreach (var component in GetComponents<Component>())
            {
                if (component is Transform) { continue; }
                var twin = Instantiate(component);
                Resources.components.Add(new WeakReference(twin));
                copy.Attach(twin);
                pairs[component] = twin;
            }
            foreach (var child in children) { copy.children.Add(child.DuplicateObjects(pairs)); }
            return copy;
        }
    }

    public static class Application
    {
        public static bool isPlaying;
        public static string dataPath { get { return "/home/me/Game/Assets"; } }
    }

    public static class Debug
    {
        public static readonly List<string> logged = new List<string>();
        public static void Log(object message) { logged.Add("" + message); }
        public static void Log(object message, Object context) { Log(message); }
        public static void LogWarning(object message) { logged.Add("warning: " + message); }
        public static void LogWarning(object message, Object context) { LogWarning(message); }
        public static void LogException(Exception exception) { logged.Add("error: " + exception); }
        public static void LogError(object message) { logged.Add("error: " + message); }
    }
}

namespace UnityEngine.Serialization
{
    [AttributeUsage(AttributeTargets.Field)]
    public class FormerlySerializedAsAttribute : Attribute { public FormerlySerializedAsAttribute(string name) { } }
}

namespace UnityEngine.SceneManagement
{
    public struct Scene : IEquatable<Scene>
    {
        public string name;
        public List<GameObject> roots;
        public GameObject[] GetRootGameObjects() { return roots.ToArray(); }
        public bool Equals(Scene other) { return name == other.name; }
        public static bool operator ==(Scene a, Scene b) { return a.Equals(b); }
        public static bool operator !=(Scene a, Scene b) { return !a.Equals(b); }
        public override bool Equals(object other) { return other is Scene && Equals((Scene)other); }
        public override int GetHashCode() { return (name ?? "").GetHashCode(); }
    }

    public static class SceneManager { public static Scene active = new Scene { name = "Main" }; }
}
