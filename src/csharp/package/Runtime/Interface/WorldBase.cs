// A world of any scalar: what holds no number.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>A rigid-body world. Worlds are made in the namespace of their scalar: new
    /// Isostep.Fixed32.World(settings). Arrays that it shows (events, poses) hold until the next call that changes
    /// it.</summary>
    public abstract unsafe partial class WorldBase : Handle
    {
        /// <summary>The fault of the last refused call; Status 0: none was.</summary>
        public IsostepException LastFault
        {
            get
            {
                FaultReport report = FaultReport.Sized();
                Check(Native.iso_world_fault(Pointer, &report));
                if (report.Status == 0) return null;
                return new IsostepException((Status)report.Status, FaultText(), NativeText.Read(report.Command),
                    NativeText.Read(report.Field), NativeText.Read(report.Expected));
            }
        }

        private string FaultText()
        {
            UIntPtr size = UIntPtr.Zero;
            CheckList(Native.iso_world_fault_text(Pointer, null, &size));
            byte[] text = new byte[(int)size];
            fixed (byte* at = text) Check(Native.iso_world_fault_text(Pointer, at, &size));
            fixed (byte* at = text) return NativeText.Read(at);
        }

        internal override void Check(Status status)
        {
            if (status != Status.Ok) throw IsostepException.OfWorld(status, Pointer);
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_world_destroy(handle));
    }

    /// <summary>A state of a world, reusable: once warm, saving allocates nothing. It may outlive the world.</summary>
    public sealed unsafe partial class Snapshot : Handle
    {
        /// <summary>A snapshot for worlds of the scalar of `like`.</summary>
        public Snapshot(WorldBase like)
        {
            IntPtr made;
            IsostepException.Check(Native.iso_snapshot_create(like.Pointer, &made));
            Pointer = made;
        }

        protected override void Destroy(IntPtr handle) => IsostepException.Check(Native.iso_snapshot_destroy(handle));
    }
}
