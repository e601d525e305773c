// Texts and arrays on their way across: bytes in, bytes out; nothing is marshalled.
// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Isostep
{
    internal static unsafe class NativeText
    {
        /// <summary>Reads up to the zero byte; null stays null.</summary>
        internal static string Read(byte* text)
        {
            if (text == null) return null;
            int size = 0;
            while (text[size] != 0) ++size;
            return size == 0 ? "" : Encoding.UTF8.GetString(Copy(text, (UIntPtr)size));
        }

        internal static string Read(byte* text, int room)
        {
            int size = 0;
            while (size < room && text[size] != 0) ++size;
            return size == 0 ? "" : Encoding.UTF8.GetString(Copy(text, (UIntPtr)size));
        }

        /// <summary>Writes into `room` bytes, the zero byte included.</summary>
        internal static void Write(string text, byte* to, int room, string name)
        {
            byte[] bytes = Bytes(text ?? "");
            if (bytes.Length > room) throw new ArgumentException("at most " + (room - 1) + " bytes", name);
            for (int i = 0; i < room; ++i) to[i] = i < bytes.Length ? bytes[i] : (byte)0;
        }

        /// <summary>The text's bytes with the zero byte that ends it; null stays null.</summary>
        internal static byte[] Bytes(string text) => text == null ? null : Encoding.UTF8.GetBytes(text + "\0");

        internal static byte[] Copy(void* bytes, UIntPtr size)
        {
            byte[] result = new byte[(int)size];
            if (result.Length != 0) Marshal.Copy((IntPtr)bytes, result, 0, result.Length);
            return result;
        }

        /// <summary>Puts bytes into `most`, zeros behind them, and returns how many. Null is none.</summary>
        internal static uint Put(byte[] bytes, byte* to, int least, int most, string name)
        {
            int size = bytes == null ? 0 : bytes.Length;
            if (size < least || size > most)
                throw new ArgumentException((least == most ? "" : least + " to ") + most + " bytes", name);
            for (int i = 0; i < most; ++i) to[i] = i < size ? bytes[i] : (byte)0;
            return (uint)size;
        }

        internal static UIntPtr Length(Array array) => (UIntPtr)(array == null ? 0 : array.Length);
    }
}
