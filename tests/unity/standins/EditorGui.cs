// The editor's drawing: what it shows is recorded, and tests say what the user clicks on.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace UnityEditor
{
    public class Editor : ScriptableObject
    {
        public UnityEngine.Object target { get; set; }
        public UnityEngine.Object[] targets { get; set; }
        public SerializedObject serializedObject { get; set; }
        public virtual void OnInspectorGUI() { }
    }

    public class CustomEditor : Attribute { public CustomEditor(Type type) { } }
    public class CanEditMultipleObjects : Attribute { }

    public class SerializedProperty
    {
        public int intValue { get; set; }
        public bool boolValue { get; set; }
    }

    public class SerializedObject : IDisposable
    {
        private readonly UnityEngine.Object target;
        private readonly SerializedProperty readable = new SerializedProperty();

        public SerializedObject(UnityEngine.Object target) { this.target = target; }

        public SerializedProperty FindProperty(string path)
        {
            return path == "m_IsReadable" ? readable : new SerializedProperty();
        }

        /// For the one property that the package changes by its name.
        public bool ApplyModifiedPropertiesWithoutUndo() { ((Mesh)target).readable = readable.boolValue; return true; }

        public void Dispose() { }
        public void Update() { }

        /// Whether the user has changed a property.
        public static bool changed;
        public bool ApplyModifiedProperties() { return changed; }
    }

    public enum MessageType { None, Info, Warning, Error }

    public static class EditorGUILayout
    {
        public static bool PropertyField(SerializedProperty property, params GUILayoutOption[] options) { return false; }
        public static bool PropertyField(SerializedProperty property, bool children, params GUILayoutOption[] options) { return false; }
        public static readonly List<string> boxes = new List<string>();
        public static void HelpBox(string text, MessageType type) { boxes.Add(text); }
        public static Rect BeginHorizontal(params GUILayoutOption[] options) { return new Rect(); }
        public static void EndHorizontal() { }
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
        private static Color color;

        public static void DrawLines(Vector3[] ends)
        {
            int before;
            drawn.TryGetValue(color, out before);
            drawn[color] = before + ends.Length;
        }

        public struct DrawingScope : IDisposable
        {
            private readonly Color before;
            public DrawingScope(Color color, Matrix4x4 matrix) { before = Handles.color; Handles.color = color; }
            public void Dispose() { Handles.color = before; }
        }
    }

    public enum SettingsScope { User, Project }
    public class SettingsProviderAttribute : Attribute { }

    public class SettingsProvider
    {
        public SettingsProvider(string path, SettingsScope scopes, IEnumerable<string> keywords = null) { }
        public Action<string> guiHandler { get; set; }
    }
}
