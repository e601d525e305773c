// Random numbers that are the same on every machine, and on both sides of the interface.
// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;

namespace Isostep
{
    /// <summary>PCG-XSH-RR, the generator of isostep's core/random.hpp: the same seed and stream draw the same numbers.
    /// It is state of the game, to be saved and hashed with it.</summary>
    /// <remarks>Source: O'Neill 2014, PCG, sec. 6.3.1.</remarks>
    [StructLayout(LayoutKind.Sequential)]
    public struct Pcg32
    {
        public ulong State;
        public ulong Increment;  // odd; names the stream

        public Pcg32(ulong seed, ulong stream)
        {
            State = 0;
            Increment = (stream << 1) | 1;
            Next();
            unchecked { State += seed; }
            Next();
        }

        public uint Next()
        {
            unchecked
            {
                ulong old = State;
                State = old * 6364136223846793005UL + Increment;
                uint mixed = (uint)(((old >> 18) ^ old) >> 27);
                int turn = (int)(old >> 59);
                return (mixed >> turn) | (mixed << ((32 - turn) & 31));
            }
        }

        /// <summary>An integer in [0, bound), each equally likely; bound > 0.</summary>
        /// <remarks>Source: Lemire 2019, Fast Random Integer Generation in an Interval, alg. 5.</remarks>
        public uint Below(uint bound)
        {
            if (bound == 0) throw new ArgumentOutOfRangeException("bound", "an integer below 0 does not exist");
            unchecked
            {
                ulong scaled = (ulong)Next() * bound;
                if ((uint)scaled < bound)
                {
                    uint rejected = (0 - bound) % bound;
                    while ((uint)scaled < rejected) scaled = (ulong)Next() * bound;
                }
                return (uint)(scaled >> 32);
            }
        }

        /// <summary>An integer in [low, high], each equally likely.</summary>
        public int Between(int low, int high)
        {
            if (high < low) throw new ArgumentOutOfRangeException("high", "below low");
            unchecked
            {
                uint span = (uint)high - (uint)low + 1;  // 0 means 2^32
                return (int)((uint)low + (span == 0 ? Next() : Below(span)));
            }
        }

        /// <summary>A number uniform in [low, high], from 24 bits; high - low must fit.</summary>
        public Q32 Uniform(Q32 low, Q32 high)
        {
            long u = (long)(Next() >> 8) << (63 - 24);
            return low + Q32.FromRaw(Rounding.Round(Rounding.Product((high - low).Raw, u), 63));
        }

        public Q16 Uniform(Q16 low, Q16 high)
        {
            int u = (int)(Next() >> 8) << (31 - 24);
            return low + Q16.FromRaw(Rounding.Round(Rounding.Product((high - low).Raw, u), 31));
        }
    }
}
