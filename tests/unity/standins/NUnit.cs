// What the package's own tests use of NUnit.
using System;

namespace NUnit.Framework
{
    [AttributeUsage(AttributeTargets.Method)]
    public class TestAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public class SetUpAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public class TearDownAttribute : Attribute { }

    public static class Assert
    {
        public static void AreEqual(object expected, object found) { Require(Equals(expected, found), "expected " + expected + ", found " + found); }
        public static void AreSame(object expected, object found) { Require(ReferenceEquals(expected, found), "another object"); }
        public static void IsTrue(bool holds) { Require(holds, "false"); }
        public static void IsFalse(bool holds) { Require(!holds, "true"); }
        private static void Require(bool holds, string what) { if (!holds) { throw new Exception(what); } }
    }
}
