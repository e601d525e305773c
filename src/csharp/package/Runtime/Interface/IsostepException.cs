// IsostepException: the fault of a call, as numbers and words.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>A call that did not succeed. It has changed nothing.</summary>
    public sealed class IsostepException : Exception
    {
        /// <summary>The status: below 0 misuse of the call, above 0 the world's refusal, see Fault.</summary>
        public readonly Status Status;

        /// <summary>The refused command, its field and its allowed values; null where no world refused.</summary>
        public readonly string Command;
        public readonly string Field;
        public readonly string Expected;

        /// <summary>The status as the world's fault; None where it is none.</summary>
        public Fault Fault => Status > 0 ? (Fault)Status : Fault.None;

        internal IsostepException(Status status, string message, string command, string field, string expected)
            : base(message)
        {
            Status = status;
            Command = command;
            Field = field;
            Expected = expected;
        }

        internal static void Check(Status status)
        {
            if (status != Status.Ok) throw Of(status, null);
        }

        /// <summary>The library's own words for its last error on this thread.</summary>
        internal static unsafe IsostepException Of(Status status, string words)
        {
            string last = words ?? NativeText.Read(Native.iso_last_error());
            if (string.IsNullOrEmpty(last)) last = NativeText.Read(Native.iso_status_text(status));
            return new IsostepException(status, last, null, null, null);
        }

        /// <summary>The exception with the status that the library has for no object.</summary>
        internal static IsostepException Disposed(string what) => Of(Status.Null, "the " + what + " was disposed");

        internal static void RequireAlive(Handle owner)
        {
            if (owner != null && owner.IsDisposed) throw Disposed(owner.GetType().Name);
        }

        internal static unsafe IsostepException OfWorld(Status status, IntPtr world)
        {
            FaultReport report = FaultReport.Sized();
            if (status < 0 || Native.iso_world_fault(world, &report) != Status.Ok) return Of(status, null);
            return new IsostepException(status, NativeText.Read(Native.iso_last_error()),
                NativeText.Read(report.Command), NativeText.Read(report.Field), NativeText.Read(report.Expected));
        }
    }
}
