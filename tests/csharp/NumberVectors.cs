// The C# numbers make of every operand in a file what the library made of it: see number_vectors.cpp.
// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Text;
using Isostep;

internal delegate void Operation(long[] operands, long[] results);

internal static class NumberVectors
{
    private static readonly Dictionary<string, Operation> operations = new Dictionary<string, Operation>();

    private static int Main(string[] arguments)
    {
        Q16Operations.Add(operations);
        Q16UnitOperations.Add(operations);
        Q32Operations.Add(operations);
        Q32UnitOperations.Add(operations);
        Fixed16Operations.Add(operations);
        Fixed32Operations.Add(operations);
        operations["Pcg32"] = Random;
        long rows = 0;
        int failures = 0, count = operations.Count;
        using (BinaryReader file = new BinaryReader(File.OpenRead(arguments[0])))
        {
            while (file.BaseStream.Position < file.BaseStream.Length) failures += Check(file, ref rows);
        }
        foreach (string name in operations.Keys)
        {
            Console.Error.WriteLine("the file has nothing of " + name);
            ++failures;
        }
        failures += Texts();
        Console.WriteLine("{0} operations, {1} rows, {2} failures", count, rows, failures);
        return failures == 0 && rows > 1000000 ? 0 : 1;
    }

    /// One operation of the file, which is then taken out of the list.
    private static int Check(BinaryReader file, ref long rows)
    {
        string name = Encoding.ASCII.GetString(file.ReadBytes((int)file.ReadInt64()));
        long[] a = new long[file.ReadInt64()], expected = new long[file.ReadInt64()];
        long[] actual = new long[expected.Length];
        long count = file.ReadInt64();
        rows += count;
        Operation operation;
        if (!operations.TryGetValue(name, out operation)) throw new Exception("nothing here does " + name);
        operations.Remove(name);
        long wrong = 0;
        for (long row = 0; row < count; ++row)
        {
            for (int i = 0; i < a.Length; ++i) a[i] = file.ReadInt64();
            for (int i = 0; i < expected.Length; ++i) expected[i] = file.ReadInt64();
            Array.Clear(actual, 0, actual.Length);
            operation(a, actual);
            if (!Differ(name, a, expected, actual, wrong == 0)) continue;
            ++wrong;
        }
        if (wrong == 0) return 0;
        Console.Error.WriteLine("{0}: {1} of {2} rows are wrong", name, wrong, count);
        return 1;
    }

    private static bool Differ(string name, long[] a, long[] expected, long[] actual, bool say)
    {
        for (int i = 0; i < expected.Length; ++i)
        {
            if (actual[i] == expected[i]) continue;
            if (say)
            {
                Console.Error.WriteLine("{0}({1}): result {2} is {3}, not {4}", name, string.Join(", ", a), i,
                    actual[i], expected[i]);
            }
            return true;
        }
        return false;
    }

    private static void Random(long[] a, long[] r)
    {
        Pcg32 random = new Pcg32(unchecked((ulong)a[0]), unchecked((ulong)a[1]));
        int low = (int)a[2], high = (int)a[3];
        r[0] = random.Next();
        r[1] = random.Below((uint)(high - low) + 1);
        r[2] = random.Between(low, high);
        r[3] = random.Uniform(Q16.FromRaw(low), Q16.FromRaw(high)).Raw;
        r[4] = random.Uniform((Q32)low, (Q32)high).Raw;
    }

    /// What is no number, and what does not fit; ties leave zero.
    private static int Texts()
    {
        int failures = 0;
        Q16 value;
        string[] noNumbers = { "", "-", ".5", "1.", "01", "1e3", "+1", " 1", "1 ", "0x1", "1,5", null, "32768",
            "-32769", "32767.99999999", "99999999999999999999999", "-32768.00001" };
        foreach (string text in noNumbers)
        {
            if (!Q16.TryParse(text, out value)) continue;
            Console.Error.WriteLine("'{0}' is read as {1}", text, value);
            ++failures;
        }
        string[] texts = { "-32768", "0.00000762939453125", "-0.00000762939453125", "0.00000762939453124", "32767.9999",
            "-0" };
        int[] raws = { int.MinValue, 1, -1, 0, int.MaxValue - 6, 0 };
        for (int i = 0; i < texts.Length; ++i)
        {
            if (Q16.Parse(texts[i]).Raw == raws[i]) continue;
            Console.Error.WriteLine("'{0}' is read as {1} raw", texts[i], Q16.Parse(texts[i]).Raw);
            ++failures;
        }
        try
        {
            Q32.Parse("one");
            ++failures;
        }
        catch (FormatException) { }
        return failures;
    }

    /// Eight characters a word.
    internal static void Pack(string text, long[] r)
    {
        for (int i = 0; i < text.Length; ++i) r[i / 8] |= (long)text[i] << (8 * (i % 8));
    }
}
