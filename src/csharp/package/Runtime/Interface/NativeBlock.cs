// Bytes that neither move nor are collected: the part of a game's state that the session saves.
// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;

namespace Isostep
{
    /// <summary>A block of zeroed memory for the game's own state: numbers, no references. Every byte of it is state.
    /// Unsafe code lays a struct over Pointer; other code reads and writes words by their offset in bytes.</summary>
    public sealed unsafe class NativeBlock : IDisposable
    {
        private IntPtr memory;
        private int sessions;  // that save and load it
        private bool isDisposed;

        public readonly int Size;

        public NativeBlock(int size)
        {
            if (size <= 0) throw new ArgumentOutOfRangeException("size", "1 byte or more");
            memory = Marshal.AllocHGlobal(size);
            Size = size;
            for (int i = 0; i < size; ++i) ((byte*)memory)[i] = 0;
        }

        public byte* Pointer
        {
            get
            {
                RequireAlive();
                return (byte*)memory;
            }
        }

        public int GetInt32(int offset)
        {
            RequireInside(offset, 4);
            return *(int*)(Pointer + offset);
        }

        public void SetInt32(int offset, int value)
        {
            RequireInside(offset, 4);
            *(int*)(Pointer + offset) = value;
        }

        public long GetInt64(int offset)
        {
            RequireInside(offset, 8);
            return *(long*)(Pointer + offset);
        }

        public void SetInt64(int offset, long value)
        {
            RequireInside(offset, 8);
            *(long*)(Pointer + offset) = value;
        }

        /// <summary>The memory goes with the last session that has it.</summary>
        public void Dispose()
        {
            isDisposed = true;
            FreeWhenUnused();
        }

        internal void Hold() { ++sessions; }

        internal void LetGo()
        {
            --sessions;
            FreeWhenUnused();
        }

        private void FreeWhenUnused()
        {
            if (!isDisposed || sessions != 0) return;
            Marshal.FreeHGlobal(memory);  // which takes zero
            memory = IntPtr.Zero;
        }

        private void RequireAlive()
        {
            if (isDisposed) throw new ObjectDisposedException("NativeBlock");
        }

        private void RequireInside(int offset, int size)
        {
            RequireAlive();
            if (offset < 0 || offset > Size - size || offset % size != 0)
                throw new ArgumentOutOfRangeException("offset", "a multiple of " + size + " within " + Size + " bytes");
        }
    }
}
