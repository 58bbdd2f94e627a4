// Prints where each field of the native structs lies, in the names of the C header.
using System;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text;

namespace Chamfer.Tests
{
    internal static class Layout
    {
        internal static void Print()
        {
            foreach (var type in typeof(MeshChamfer).Assembly.GetTypes())
            {
                if (type.Namespace != "Chamfer.Interop" || !type.IsValueType || type.IsNested) { continue; }
                string name = "chamfer_" + Snake(type.Name.Substring("Native".Length));
                Console.WriteLine(name + " " + Marshal.SizeOf(type));
                foreach (var field in type.GetFields(BindingFlags.Instance | BindingFlags.Public))
                {
                    Console.WriteLine(name + "." + Snake(field.Name) + " " + Marshal.OffsetOf(type, field.Name));
                }
            }
        }

        private static string Snake(string name)
        {
            var snake = new StringBuilder();
            foreach (char letter in name)
            {
                if (char.IsUpper(letter) && snake.Length > 0) { snake.Append('_'); }
                snake.Append(char.ToLowerInvariant(letter));
            }
            return snake.ToString();
        }
    }
}
