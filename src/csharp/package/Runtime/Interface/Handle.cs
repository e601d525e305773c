// Handle: the owner of an object of the library.
// SPDX-License-Identifier: MIT
using System;

namespace Isostep
{
    /// <summary>Dispose() frees the object, once, on the thread that uses it. There is no finalizer: an object that is
    /// not disposed is a leak, never a crash.</summary>
    public abstract class Handle : IDisposable
    {
        private IntPtr pointer;

        /// <summary>The pointer that every call is given; throws once disposed, whatever is asked.</summary>
        internal IntPtr Pointer
        {
            get
            {
                if (pointer == IntPtr.Zero) throw IsostepException.Disposed(GetType().Name);
                return pointer;
            }
            set { pointer = value; }
        }

        /// <summary>The address for Native. It is zero once disposed; the library refuses that as ISO_NULL.</summary>
        public IntPtr Address => pointer;

        public bool IsDisposed => pointer == IntPtr.Zero;

        public void Dispose()
        {
            if (pointer == IntPtr.Zero) return;
            Destroy(pointer);
            pointer = IntPtr.Zero;
        }

        /// <summary>Destroys the object; one that the library refuses to end stays as it was.</summary>
        protected abstract void Destroy(IntPtr handle);

        internal virtual void Check(Status status) => IsostepException.Check(status);

        /// <summary>Checks the status of a list: too little room is no error, the count shows it.</summary>
        internal void CheckList(Status status)
        {
            if (status != Status.SmallBuffer) Check(status);
        }
    }
}
