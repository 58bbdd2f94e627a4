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
        private sealed class Step { public int Group; public string Name; public Action Revert; }

        private static readonly List<Step> steps = new List<Step>();
        private static int group;
        private static string groupName;

        public static int GetCurrentGroup() { return group; }
        public static void IncrementCurrentGroup() { group++; groupName = null; }
        public static void SetCurrentGroupName(string name) { groupName = name; }
        public static void RecordObject(Object target, string name) { Add(name, Snapshot(target)); }
        public static void RegisterCompleteObjectUndo(Object target, string name) { Add(name, Snapshot(target)); }
        public static void RegisterCreatedObjectUndo(Object target, string name) { Add(name, () => target.destroyed = true); }

        public static void DestroyObjectImmediate(Object target)
        {
            target.destroyed = true;
            Add("Destroy", () => target.destroyed = false);
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
            int last = steps.Last().Group;
            foreach (var step in steps.Where(step => step.Group == last).Reverse().ToList()) { step.Revert(); }
            steps.RemoveAll(step => step.Group == last);
            group++;
        }

        private static void Add(string name, Action revert)
        {
            steps.Add(new Step { Group = group, Name = groupName ?? name, Revert = revert });
        }

        private static Action Snapshot(Object target)
        {
            var fields = new Dictionary<FieldInfo, object>();
            for (var type = target.GetType(); type != typeof(Object); type = type.BaseType)
            {
                var declared = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;
                foreach (var field in type.GetFields(declared)) { fields[field] = Copy(field.GetValue(target)); }
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
