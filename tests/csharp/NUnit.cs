// What the package's tests use of NUnit, which Unity brings: attributes, assertions, and a runner for here.
// SPDX-License-Identifier: MIT
using System;
using System.Reflection;

namespace NUnit.Framework
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TestAttribute : Attribute { }

    public static class Assert
    {
        public static void IsTrue(bool fact, string otherwise = "not true")
        {
            if (!fact) throw new Exception(otherwise);
        }
        public static void AreEqual<T>(T expected, T actual) =>
            IsTrue(expected.Equals(actual), expected + " is " + actual);
        public static void AreNotEqual<T>(T a, T b) => IsTrue(!a.Equals(b), a + " twice");
        public static void Greater(ulong a, ulong b) => IsTrue(a > b, a + " is not above " + b);
    }

    internal static class Runner
    {
        private static int Main()
        {
            int count = 0;
            foreach (Type type in Assembly.GetExecutingAssembly().GetTypes())
            {
                foreach (MethodInfo method in type.GetMethods())
                {
                    if (method.GetCustomAttribute<TestAttribute>() == null) continue;
                    method.Invoke(Activator.CreateInstance(type), null);
                    Console.WriteLine(method.Name);
                    ++count;
                }
            }
            return count > 0 ? 0 : 1;
        }
    }
}
