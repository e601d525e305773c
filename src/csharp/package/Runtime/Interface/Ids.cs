// Ids, and the vectors of what is drawn.
// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;

namespace Isostep
{
    /// <summary>A body of a world; of one that is gone the id is stale, and refused.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyId : IEquatable<BodyId>
    {
        public ulong Value;

        public BodyId(ulong value) { Value = value; }

        /// <summary>The place in the world's list; generations share it one after another.</summary>
        public uint Slot => unchecked((uint)Value);
        public uint Generation => (uint)(Value >> 32);
        public bool IsNull => Value == 0;

        public static bool operator ==(BodyId a, BodyId b) => a.Value == b.Value;
        public static bool operator !=(BodyId a, BodyId b) => a.Value != b.Value;
        public bool Equals(BodyId other) => Value == other.Value;
        public override bool Equals(object other) => other is BodyId && Equals((BodyId)other);
        public override int GetHashCode() => Value.GetHashCode();
        public override string ToString() => Slot + "." + Generation;
    }

    /// <summary>A shape of a world, which any number of bodies share.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ShapeId : IEquatable<ShapeId>
    {
        public ulong Value;

        public ShapeId(ulong value) { Value = value; }

        /// <summary>The place in the world's list; generations share it one after another.</summary>
        public uint Slot => unchecked((uint)Value);
        public uint Generation => (uint)(Value >> 32);
        public bool IsNull => Value == 0;

        public static bool operator ==(ShapeId a, ShapeId b) => a.Value == b.Value;
        public static bool operator !=(ShapeId a, ShapeId b) => a.Value != b.Value;
        public bool Equals(ShapeId other) => Value == other.Value;
        public override bool Equals(object other) => other is ShapeId && Equals((ShapeId)other);
        public override int GetHashCode() => Value.GetHashCode();
        public override string ToString() => Slot + "." + Generation;
    }

    /// <summary>A joint of a world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct JointId : IEquatable<JointId>
    {
        public ulong Value;

        public JointId(ulong value) { Value = value; }

        /// <summary>The place in the world's list; generations share it one after another.</summary>
        public uint Slot => unchecked((uint)Value);
        public uint Generation => (uint)(Value >> 32);
        public bool IsNull => Value == 0;

        public static bool operator ==(JointId a, JointId b) => a.Value == b.Value;
        public static bool operator !=(JointId a, JointId b) => a.Value != b.Value;
        public bool Equals(JointId other) => Value == other.Value;
        public override bool Equals(object other) => other is JointId && Equals((JointId)other);
        public override int GetHashCode() => Value.GetHashCode();
        public override string ToString() => Slot + "." + Generation;
    }

    /// <summary>A record of a world, of the kind that its Add returned it for.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RecordId : IEquatable<RecordId>
    {
        public ulong Value;

        public RecordId(ulong value) { Value = value; }

        /// <summary>The place in the world's list; generations share it one after another.</summary>
        public uint Slot => unchecked((uint)Value);
        public uint Generation => (uint)(Value >> 32);
        public bool IsNull => Value == 0;

        public static bool operator ==(RecordId a, RecordId b) => a.Value == b.Value;
        public static bool operator !=(RecordId a, RecordId b) => a.Value != b.Value;
        public bool Equals(RecordId other) => Value == other.Value;
        public override bool Equals(object other) => other is RecordId && Equals((RecordId)other);
        public override int GetHashCode() => Value.GetHashCode();
        public override string ToString() => Slot + "." + Generation;
    }

    /// <summary>A position for drawing [m], relative to the world's origin.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Float3
    {
        public float X;
        public float Y;
        public float Z;
    }

    /// <summary>An orientation for drawing, a unit quaternion.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Float4
    {
        public float X;
        public float Y;
        public float Z;
        public float W;
    }
}
