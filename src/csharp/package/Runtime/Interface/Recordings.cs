// Recordings of what a game does to a world, and their proof.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>A recording that grows: world.Record(tape, "scene"), then EndFrame() after each frame, then Finish()
    /// and Bytes: a file that `isostep verify` plays without the game.</summary>
    public sealed unsafe partial class Tape : Handle
    {
        public Tape()
        {
            IntPtr made;
            IsostepException.Check(Native.iso_tape_create(&made));
            Pointer = made;
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_tape_destroy(handle));
    }

    /// <summary>A recording that is read.</summary>
    public sealed unsafe partial class Replay : Handle
    {
        /// <summary>A whole or a truncated file, which is copied.</summary>
        public Replay(byte[] file)
        {
            IntPtr made;
            fixed (byte* at = file) IsostepException.Check(Native.iso_replay_open(at, NativeText.Length(file), &made));
            Pointer = made;
        }

        /// <summary>Reads the file's description of itself, without playing it.</summary>
        public static ReplayInfo About(byte[] file)
        {
            ReplayInfo info = ReplayInfo.Sized();
            fixed (byte* at = file) IsostepException.Check(Native.iso_replay_about(at, NativeText.Length(file), &info));
            return info;
        }

        /// <summary>Plays the file, at most so many frames, and compares every hash, like `isostep verify`. The
        /// outcome is in the result, whatever it is.</summary>
        public static ReplayResult Verify(byte[] file, ulong mostFrames = ulong.MaxValue, Simd simd = Simd.Best)
        {
            ReplayResult result = ReplayResult.Sized();
            fixed (byte* at = file)
            {
                UIntPtr size = NativeText.Length(file);
                IsostepException.Check(Native.iso_replay_verify(at, size, simd, mostFrames, &result));
            }
            return result;
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_replay_destroy(handle));
    }

    /// <summary>Points of a hull, triangles of a mesh or heights of a field: shared by all worlds, immutable.</summary>
    public sealed unsafe partial class Blob : Handle
    {
        internal Blob(IntPtr made) { Pointer = made; }

        /// <summary>A file of `isostep bake`, or what Write() gave.</summary>
        public static Blob Read(byte[] file, BlobHome home = BlobHome.Carried)
        {
            IntPtr made;
            fixed (byte* at = file)
                IsostepException.Check(Native.iso_blob_read(at, NativeText.Length(file), home, &made));
            return new Blob(made);
        }

        /// <summary>Makes a mesh: points x, y, z [m], triangles by three points, anticlockwise from outside.</summary>
        public static Blob Mesh(double[] points, uint[] vertices, BlobHome home = BlobHome.Carried)
        {
            IntPtr made;
            fixed (double* pointsAt = points)
            fixed (uint* verticesAt = vertices)
            {
                Triangles triangles = Triangles.Sized();
                triangles.PointCount = (uint)(points.Length / 3);
                triangles.TriangleCount = (uint)(vertices.Length / 3);
                triangles.Points = pointsAt;
                triangles.Vertices = verticesAt;
                IsostepException.Check(Native.iso_blob_create_mesh(&triangles, null, home, &made));
            }
            return new Blob(made);
        }

        /// <summary>Makes a height field: heights [m] by rows, `pitch` [m] apart.</summary>
        public static Blob HeightField(double[] heights, int columns, double pitch, BlobHome home = BlobHome.Carried)
        {
            IntPtr made;
            fixed (double* at = heights)
            {
                HeightSheet sheet = HeightSheet.Sized();
                sheet.Columns = (uint)columns;
                sheet.Rows = (uint)(heights.Length / columns);
                sheet.Pitch = pitch;
                sheet.Heights = at;
                IsostepException.Check(Native.iso_blob_create_height_field(&sheet, null, home, &made));
            }
            return new Blob(made);
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_blob_destroy(handle));
    }
}
