// What Unity does to the references of what it copies: those within the copy are to the copies.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    internal static class Duplicates
    {
        private const BindingFlags Declared = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

        internal static void Redirect(object target, Dictionary<object, object> pairs)
        {
            for (var type = target.GetType(); type != typeof(Component) && type != typeof(object); type = type.BaseType)
            {
                foreach (var field in type.GetFields(Declared)) { field.SetValue(target, Copy(field.GetValue(target), pairs)); }
            }
        }

        private static object Copy(object value, Dictionary<object, object> pairs)
        {
            object twin;
            if (value is Object) { return pairs.TryGetValue(value, out twin) ? twin : value; }
            if (value is Array) { return CopyArray((Array)((Array)value).Clone(), pairs); }
            if (value is IList) { return CopyList((IList)value, pairs); }
            // Structs of the package that are serialized.
            if (value != null && value.GetType().IsValueType && !value.GetType().IsPrimitive && value.GetType().Namespace == "Chamfer")
            {
                if (!value.GetType().IsEnum) { Redirect(value, pairs); }
            }
            return value;
        }

        private static object CopyArray(Array copy, Dictionary<object, object> pairs)
        {
            for (int i = 0; i < copy.Length; i++) { copy.SetValue(Copy(copy.GetValue(i), pairs), i); }
            return copy;
        }

        private static object CopyList(IList list, Dictionary<object, object> pairs)
        {
            var copy = (IList)Activator.CreateInstance(list.GetType());
            foreach (object item in list) { copy.Add(Copy(item, pairs)); }
            return copy;
        }
    }
}
