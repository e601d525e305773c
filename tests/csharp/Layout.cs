// Every struct lies in C#'s memory as in C's: see LayoutTable.cs and layout.c.
// SPDX-License-Identifier: MIT
using System;
using System.Reflection;
using System.Runtime.InteropServices;

internal static class Layout
{
    internal static void Check()
    {
        int fields = 0;
        foreach (LayoutTable.Row row in LayoutTable.Rows)
        {
            int size = Marshal.SizeOf(row.Type);
            if (size != row.Size) throw new Exception(row.Type + " has " + size + " bytes");
            FieldInfo[] members =
                row.Type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
            Array.Sort(members, (a, b) => a.MetadataToken.CompareTo(b.MetadataToken));
            int at = 0;
            for (int i = 0; i < row.Offsets.Length; ++i)
            {
                int copies = 1;
                if (row.Offsets[i] < 0) copies = -row.Offsets[i++];  // an array that C# has as so many members
                long offset = (long)Marshal.OffsetOf(row.Type, members[at].Name);
                if (offset != row.Offsets[i])
                    throw new Exception(row.Type + "." + members[at].Name + " is at " + offset);
                at += copies;
                ++fields;
            }
            if (at != members.Length) throw new Exception(row.Type + " has " + members.Length + " members");
        }
        if (fields < 2000) throw new Exception("only " + fields + " members were looked at");
    }
}
