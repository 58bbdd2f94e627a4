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

    public class SerializedProperty { public int intValue { get; set; } }

    public class SerializedObject
    {
        public SerializedObject(UnityEngine.Object target) { }
        public SerializedProperty FindProperty(string path) { return new SerializedProperty(); }
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

    public struct Rect { }

    public static class Handles
    {
        public static Matrix4x4 matrix { get; set; }
        public static Color color { get; set; }
        public static void DrawLines(Vector3[] ends) { }
    }

    public enum SettingsScope { User, Project }
    public class SettingsProviderAttribute : Attribute { }

    public class SettingsProvider
    {
        public SettingsProvider(string path, SettingsScope scopes, IEnumerable<string> keywords = null) { }
        public Action<string> guiHandler { get; set; }
    }
}
