// The editor's drawing, which does nothing here: it only has to compile.
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
        public bool ApplyModifiedProperties() { return false; }
    }

    public enum MessageType { None, Info, Warning, Error }

    public static class EditorGUILayout
    {
        public static bool PropertyField(SerializedProperty property, params GUILayoutOption[] options) { return false; }
        public static bool PropertyField(SerializedProperty property, bool children, params GUILayoutOption[] options) { return false; }
        public static void HelpBox(string text, MessageType type) { }
        public static Rect BeginHorizontal(params GUILayoutOption[] options) { return new Rect(); }
        public static void EndHorizontal() { }
    }

    public static class EditorGUI
    {
        public struct DisabledScope : IDisposable
        {
            public DisabledScope(bool disabled) { }
            public void Dispose() { }
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
