// The editor's drawing: what it shows is recorded, and tests say what the user clicks on.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace UnityEngine
{
    public class GUILayoutOption { }
    public class GUIStyle { }
    public class Texture : Object { }
    public class Texture2D : Texture { }
    public class ExitGUIException : Exception { }

    public class GUIContent
    {
        public readonly string text, tooltip;
        public GUIContent(string text, string tooltip) { this.text = text; this.tooltip = tooltip; }
    }

    public enum EventType { Repaint, DragUpdated, DragPerform }

    public class Event
    {
        public static Event current = new Event();
        public EventType type;
        public Vector2 mousePosition;
    }

    public static class GUI { public static void Box(Rect place, string text) { GUILayout.Lay(true); } }
    public static class GUILayoutUtility { public static Rect GetRect(float width, float height, params GUILayoutOption[] options) { return GUILayout.Lay(new Rect()); } }

    public static class GUIUtility
    {
        /// Ends what is drawn at once, which is what Unity wants after a dialogue.
        public static void ExitGUI() { GUILayout.broken = false; throw new ExitGUIException(); }
    }

    public static class GUILayout
    {
        /// The button that the mouse is on; only one reacts to a click.
        public static string clicked;
        /// Whether a dialogue was shown since: what is laid out after one is an error in Unity.
        public static bool broken;
        /// How many groups are open.
        public static int depth;
        public static readonly Dictionary<string, string> tooltips = new Dictionary<string, string>();

        internal static T Lay<T>(T value)
        {
            if (broken) { throw new InvalidOperationException("Invalid GUILayout state"); }
            return value;
        }

        public static GUILayoutOption Width(float width) { return new GUILayoutOption(); }
        public static GUILayoutOption ExpandWidth(bool expand) { return new GUILayoutOption(); }
        public static GUILayoutOption Height(float height) { return new GUILayoutOption(); }
        public static void Label(Texture picture, params GUILayoutOption[] options) { Lay(true); }

        public static bool Button(GUIContent content, params GUILayoutOption[] options)
        {
            tooltips[content.text] = UnityEditor.EditorGUI.disabled ? content.tooltip : "";
            return Button(content.text);
        }

        public static bool Button(string text, params GUILayoutOption[] options)
        {
            Lay(text);
            if (text != clicked || UnityEditor.EditorGUI.disabled) { return false; }
            clicked = null;
            return true;
        }
    }
}

namespace UnityEditor
{
    public class Editor : ScriptableObject
    {
        public UnityEngine.Object target { get; set; }
        public UnityEngine.Object[] targets { get; set; }
        public SerializedObject serializedObject { get; set; }
        public virtual void OnInspectorGUI() { }
    }

    public enum DragAndDropVisualMode { None, Link }

    public static class DragAndDrop
    {
        public static string[] paths = new string[0];
        public static DragAndDropVisualMode visualMode;
        public static void AcceptDrag() { }
    }

    public class EditorWindow : ScriptableObject
    {
        public static EditorWindow opened;
        public static T GetWindow<T>(string title) where T : EditorWindow, new() { var window = new T(); opened = window; return window; }
        public void Show() { }
    }

    public static class EditorStyles { public static GUIStyle wordWrappedLabel { get { return new GUIStyle(); } } }
    public static class AssetPreview { public static Texture2D GetAssetPreview(UnityEngine.Object asset) { return null; } }
    public static class EditorGUIUtility { public static void PingObject(UnityEngine.Object target) { } }

    public class CustomEditor : Attribute { public CustomEditor(Type type) { } }
    public class CanEditMultipleObjects : Attribute { }

    public class SerializedProperty
    {
        public int intValue { get; set; }
        public bool boolValue { get; set; }
        /// Such as "settings.width".
        public string propertyPath { get; set; }
    }

    /// Knows by name what the package changes so: of meshes, what Unity has no other way to change.
    public class SerializedObject : IDisposable
    {
        private readonly Dictionary<string, SerializedProperty> flags = new Dictionary<string, SerializedProperty>();
        private readonly Mesh mesh;
        private readonly UnityEngine.Object target;

        public SerializedObject(UnityEngine.Object target)
        {
            this.target = target;
            mesh = target as Mesh;
            if (ReferenceEquals(mesh, null)) { return; }
            flags["m_IsReadable"] = new SerializedProperty { boolValue = mesh.readable };
            flags["m_KeepVertices"] = new SerializedProperty { boolValue = mesh.keepVertices };
            flags["m_KeepIndices"] = new SerializedProperty { boolValue = mesh.keepIndices };
        }

        public SerializedProperty FindProperty(string path)
        {
            SerializedProperty flag;
            if (flags.TryGetValue(path, out flag)) { return flag; }
            return ReferenceEquals(mesh, null) && IsField(path) ? new SerializedProperty { propertyPath = path } : null;
        }

        /// Whether the object has what a path names: Unity knows no other.
        private bool IsField(string path)
        {
            var type = target.GetType();
            foreach (string name in path.Split('.'))
            {
                var all = System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.Public | System.Reflection.BindingFlags.NonPublic;
                var field = type.GetField(name, all);
                if (field == null) { return false; }
                type = field.FieldType;
            }
            return true;
        }

        public bool ApplyModifiedPropertiesWithoutUndo()
        {
            mesh.readable = flags["m_IsReadable"].boolValue;
            mesh.keepVertices = flags["m_KeepVertices"].boolValue;
            mesh.keepIndices = flags["m_KeepIndices"].boolValue;
            return true;
        }

        public void Dispose() { }
        public void Update() { }

        /// Whether the user has changed a property.
        public static bool changed;
        public bool ApplyModifiedProperties() { return changed; }
    }

    public static class SceneView { public static int repaints; public static void RepaintAll() { repaints++; } }

    public enum MessageType { None, Info, Warning, Error }

    public static class EditorGUILayout
    {
        /// What was drawn, with a star for all that is in it.
        public static readonly List<string> properties = new List<string>();
        public static bool PropertyField(SerializedProperty property, params GUILayoutOption[] options) { return PropertyField(property, false); }
        public static bool PropertyField(SerializedProperty property, bool children, params GUILayoutOption[] options)
        {
            properties.Add(property.propertyPath + (children ? "*" : ""));
            return GUILayout.Lay(false);
        }
        public static readonly List<string> boxes = new List<string>();
        public static void HelpBox(string text, MessageType type) { GUILayout.Lay(true); boxes.Add(text); }
        public static Vector2 BeginScrollView(Vector2 place, params GUILayoutOption[] options) { GUILayout.depth++; return GUILayout.Lay(place); }
        public static void EndScrollView() { GUILayout.depth--; GUILayout.Lay(true); }
        public static Rect BeginVertical(params GUILayoutOption[] options) { GUILayout.depth++; return GUILayout.Lay(new Rect()); }
        public static void EndVertical() { GUILayout.depth--; GUILayout.Lay(true); }
        public static void LabelField(string text, GUIStyle style, params GUILayoutOption[] options) { GUILayout.Lay(true); boxes.Add(text); }
        public static Rect BeginHorizontal(params GUILayoutOption[] options) { GUILayout.depth++; return GUILayout.Lay(new Rect()); }
        public static void EndHorizontal() { GUILayout.depth--; GUILayout.Lay(true); }
    }

    public static class EditorGUI
    {
        public static bool disabled;

        public struct DisabledScope : IDisposable
        {
            private readonly bool before;
            public DisabledScope(bool disabled) { before = EditorGUI.disabled; EditorGUI.disabled |= disabled; }
            public void Dispose() { disabled = before; }
        }
    }

    public static class Handles
    {
        /// How many points were drawn in each colour.
        public static readonly Dictionary<Color, int> drawn = new Dictionary<Color, int>();
        /// What is drawn in front of, or behind, what is there.
        public static UnityEngine.Rendering.CompareFunction zTest = UnityEngine.Rendering.CompareFunction.Always;
        public static readonly Dictionary<Color, UnityEngine.Rendering.CompareFunction> tested = new Dictionary<Color, UnityEngine.Rendering.CompareFunction>();
        public static readonly List<Vector3> points = new List<Vector3>();
        private static Color color;
        private static Matrix4x4 matrix;

        public static void DrawLines(Vector3[] ends)
        {
            int before;
            drawn.TryGetValue(color, out before);
            drawn[color] = before + ends.Length;
            tested[color] = zTest;
            foreach (var end in ends) { points.Add(matrix.MultiplyPoint3x4(end)); }
        }

        public struct DrawingScope : IDisposable
        {
            private readonly Color before;
            public DrawingScope(Color color, Matrix4x4 matrix) { before = Handles.color; Handles.color = color; Handles.matrix = matrix; }
            public void Dispose() { Handles.color = before; }
        }
    }

    public enum SettingsScope { User, Project }
    public class SettingsProviderAttribute : Attribute { }

    public class SettingsProvider
    {
        public SettingsProvider(string path, SettingsScope scopes, IEnumerable<string> keywords = null) { }
        public Action<string> guiHandler { get; set; }
        public Action<string, object> activateHandler { get; set; }
        public Action deactivateHandler { get; set; }
    }
}
