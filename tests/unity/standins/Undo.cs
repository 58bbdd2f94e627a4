// Undo that really undoes: it keeps copies of what objects held before they changed.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public static class Undo
    {
        private sealed class Step { public int Group; public string Name; public Action Revert; public Object Target; }

        private static readonly List<Step> steps = new List<Step>();
        private static int group;
        private static string groupName;

        public delegate void UndoRedoCallback();
        public static UndoRedoCallback undoRedoPerformed;

        public static int GetCurrentGroup() { return group; }
        public static void IncrementCurrentGroup() { group++; groupName = null; }
        public static void SetCurrentGroupName(string name) { groupName = name; }
        public static void RecordObject(Object target, string name) { Add(name, target, Snapshot(target)); }
        public static void RegisterCompleteObjectUndo(Object target, string name) { Add(name, target, Snapshot(target)); }
        public static void RegisterCreatedObjectUndo(Object target, string name) { Add(name, target, () => target.destroyed = true); }

        public static T AddComponent<T>(UnityEngine.GameObject item) where T : UnityEngine.Component, new()
        {
            var component = item.AddComponent<T>();
            RegisterCreatedObjectUndo(component, "Add Component");
            return component;
        }

        /// Forgets all that is known of an object.
        public static void ClearUndo(Object target) { steps.RemoveAll(step => ReferenceEquals(step.Target, target)); }

        public static void DestroyObjectImmediate(Object target)
        {
            target.destroyed = true;
            Add("Destroy", target, () => target.destroyed = false);
        }

        public static void CollapseUndoOperations(int from)
        {
            foreach (var step in steps.Where(step => step.Group > from)) { step.Group = from; }
        }

        /// What the menu entry Undo would name; null if there is nothing to undo.
        public static string Last { get { return steps.Count > 0 ? steps.Last().Name : null; } }

        /// How many things the last step would revert.
        public static int LastCount { get { return steps.Count(step => step.Group == steps.Last().Group); } }

        /// Begins a new step, as a click of the mouse does.
        public static void Click() { IncrementCurrentGroup(); }

        public static void PerformUndo()
        {
            RevertAllDownToGroup(steps.Last().Group);
            group++;
            if (undoRedoPerformed != null) { undoRedoPerformed(); }
        }

        public static void RevertAllDownToGroup(int from)
        {
            foreach (var step in steps.Where(step => step.Group >= from).Reverse().ToList()) { step.Revert(); }
            steps.RemoveAll(step => step.Group >= from);
        }

        private static void Add(string name, Object target, Action revert)
        {
            steps.Add(new Step { Group = group, Name = groupName ?? name, Revert = revert, Target = target });
        }

        private static Action Snapshot(Object target)
        {
            var fields = new Dictionary<FieldInfo, object>();
            for (var type = target.GetType(); type != typeof(Object); type = type.BaseType)
            {
                var declared = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;
                foreach (var field in type.GetFields(declared).Where(field => !field.IsNotSerialized)) { fields[field] = Copy(field.GetValue(target)); }
            }
            return () => { foreach (var entry in fields) { entry.Key.SetValue(target, Copy(entry.Value)); } };
        }

        private static object Copy(object value)
        {
            if (value is Array) { return ((Array)value).Clone(); }
            return value is IList ? Activator.CreateInstance(value.GetType(), value) : value;
        }
    }
}
