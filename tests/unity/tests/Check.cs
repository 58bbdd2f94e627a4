// Assertions, and the program that runs every public static method of the test classes.
using System;
using System.Collections.Generic;
using System.Reflection;

namespace Chamfer.Tests
{
    internal static class Check
    {
        internal static void That(bool holds, string what)
        {
            if (!holds) { throw new Exception(what); }
        }

        internal static void Equal<T>(T expected, T found)
        {
            That(EqualityComparer<T>.Default.Equals(expected, found), "expected " + expected + ", found " + found);
        }

        internal static void Near(float expected, float found)
        {
            That(Math.Abs(expected - found) <= 1e-5f, "expected about " + expected + ", found " + found);
        }

        internal static T Throws<T>(Action action) where T : Exception
        {
            try { action(); }
            catch (T exception) { return exception; }
            throw new Exception("expected " + typeof(T).Name);
        }
    }

    internal static class Program
    {
        private static int Main(string[] arguments)
        {
            if (arguments.Length > 0 && arguments[0] == "layout") { Layout.Print(); return 0; }
            if (arguments.Length > 0 && arguments[0] == "carry") { Carry.Run(arguments[1], arguments[2], arguments[3]); return 0; }
            if (arguments.Length > 0 && arguments[0] == "drag") { Drag.Measure(); return 0; }
            bool stopsAtFirst = arguments.Length > 0 && arguments[0] == "first";
            int failures = 0, passes = 0;
            foreach (var type in Assembly.GetExecutingAssembly().GetTypes())
            {
                if (!type.Name.EndsWith("Tests")) { continue; }
                foreach (var test in type.GetMethods(BindingFlags.Static | BindingFlags.Public))
                {
                    try { test.Invoke(null, null); passes++; }
                    catch (TargetInvocationException exception)
                    {
                        failures++;
                        Console.WriteLine("FAILED " + type.Name + "." + test.Name + ": " + exception.InnerException);
                        if (stopsAtFirst) { return failures; }
                    }
                }
            }
            Console.WriteLine(passes + " passed, " + failures + " failed");
            return failures;
        }
    }
}
