// What owns an object of the library.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>Dispose() frees the object, once, on the thread that uses it. There is no finalizer: an object that is
    /// not disposed is a leak, never a crash.</summary>
    public abstract class Handle : IDisposable
    {
        internal IntPtr Pointer;

        /// <summary>For Native. Zero once disposed; the library refuses that as ISO_NULL.</summary>
        public IntPtr Address => Pointer;

        public bool IsDisposed => Pointer == IntPtr.Zero;

        public void Dispose()
        {
            if (Pointer == IntPtr.Zero) return;
            Destroy(Pointer);
            Pointer = IntPtr.Zero;
        }

        /// <summary>One that the library refuses to end stays as it was.</summary>
        protected abstract void Destroy(IntPtr handle);

        internal virtual void Check(Status status) => IsostepException.Check(status);

        /// <summary>For lists: too little room is no error, the count says it.</summary>
        internal void CheckList(Status status)
        {
            if (status != Status.SmallBuffer) Check(status);
        }
    }
}
