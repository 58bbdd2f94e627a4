// Unity's objects and components, as far as the package uses them.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public class Object
    {
        public string name { get; set; }
        public bool destroyed;
        public static void DestroyImmediate(Object target) { target.destroyed = true; }
        public static void Destroy(Object target) { target.destroyed = true; }
        public static T Instantiate<T>(T original) where T : Object { return (T)original.MemberwiseClone(); }
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

    public class DisallowMultipleComponent : Attribute { }

    public class AddComponentMenu : Attribute { public AddComponentMenu(string path) { } }

    [Flags]
    public enum HideFlags { None = 0, NotEditable = 8 }

    public class ScriptableObject : Object { public HideFlags hideFlags { get; set; } }

    public class Transform : Component
    {
        public Vector3 localPosition { get; set; }
        public Vector3 localScale { get; set; }
        public Quaternion localRotation { get; set; }
        public Transform parent { get; internal set; }
        public Matrix4x4 worldToLocalMatrix { get { return localToWorldMatrix.inverse; } }
        public Transform() { localScale = new Vector3(1, 1, 1); }

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
        public GameObject gameObject { get; internal set; }
        public Transform transform { get { return gameObject.transform; } }

        public T GetComponent<T>()
        {
            var found = gameObject.GetComponents<T>();
            return found.Length > 0 ? found[0] : default(T);
        }

        public T[] GetComponentsInChildren<T>() { return gameObject.GetComponentsInChildren<T>(false); }
    }

    public class MonoBehaviour : Component { }
    public class Material : Object { }
    public class MeshFilter : Component { public Mesh sharedMesh { get; set; } }
    public class MeshRenderer : Renderer { }
    public class SkinnedMeshRenderer : Renderer { public Mesh sharedMesh { get; set; } }

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
        public readonly Children children;
        public Transform transform { get; private set; }
        public GameObject(string name) { this.name = name; transform = AddComponent<Transform>(); children = new Children(transform); }

        public T AddComponent<T>() where T : Component, new()
        {
            var component = new T { name = name };
            component.gameObject = this;
            components.Add(component);
            return component;
        }

        public T[] GetComponents<T>()
        {
            var found = new List<T>();
            foreach (object component in components) { if (component is T) { found.Add((T)component); } }
            return found.ToArray();
        }

        public T[] GetComponentsInChildren<T>(bool includeInactive)
        {
            var found = new List<T>(GetComponents<T>());
            foreach (var child in children) { found.AddRange(child.GetComponentsInChildren<T>(includeInactive)); }
            return found.ToArray();
        }
    }

    public static class Application { public static string dataPath { get { return "/home/me/Game/Assets"; } } }

    public static class Debug
    {
        public static readonly List<string> logged = new List<string>();
        public static void Log(object message) { logged.Add("" + message); }
        public static void Log(object message, Object context) { Log(message); }
        public static void LogWarning(object message) { logged.Add("warning: " + message); }
        public static void LogWarning(object message, Object context) { LogWarning(message); }
        public static void LogError(object message) { logged.Add("error: " + message); }
    }

    public class GUILayoutOption { }

    public static class GUILayout
    {
        /// The button that the mouse is on; only one reacts to a click.
        public static string clicked;

        public static bool Button(string text, params GUILayoutOption[] options)
        {
            if (text != clicked || UnityEditor.EditorGUI.disabled) { return false; }
            clicked = null;
            return true;
        }
    }
}
