// Square roots, directions and unit quaternions: a seed table, one third-order step, trial of the exact square.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    /// <summary>The number 1 / sqrt of a sum of squares q, ready to multiply its terms.</summary>
    internal struct InverseLength
    {
        internal ulong M;  // q 2^(2 Half) / 2^64 to nearest, in [2^62, 2^64)
        internal ulong Y;  // 2^64 / sqrt(M / 2^62)
        internal int Half;

        internal InverseLength(Wide q)
        {
            int zeros = Wide.LeadingZeros(q) & ~1;
            Wide shifted = q << zeros;
            ulong rounded = unchecked(shifted.High + (shifted.Low >> 63));
            M = unchecked(rounded - (rounded == 0 ? 1u : 0u));
            Y = Roots.RsqrtQ64(M);
            Half = zeros / 2;
        }

        /// <summary>The component c as a Unit of `fraction` bits.</summary>
        internal long Scale(long c, int fraction)
        {
            int drop = 63 - fraction;
            ulong fine = Wide.MultiplyHigh(Wide.Magnitude(c) << Half, Y);
            long size = unchecked((long)((fine + (1UL << (drop - 1))) >> drop));
            return c < 0 ? -size : size;
        }

        /// <summary>Returns sqrt(q) to nearest.</summary>
        internal ulong LengthOf(Wide q)
        {
            ulong root = Wide.MultiplyHigh(M, Y);
            ulong guess = Wide.ShiftRightRounded(unchecked(root << 1), Half);
            return Roots.NearestRoot(q - Wide.Multiply(guess, guess), guess);
        }
    }

    internal static class Roots
    {
        /// <summary>Returns 2^64 / sqrt(m / 2^62) for m in [2^62, 2^64); 1 itself is given as 1 - 2^-64.</summary>
        internal static ulong RsqrtQ64(ulong m)
        {
            unchecked
            {
                int cell = (int)(m >> 56) - 64;
                uint seed = Tables.RsqrtValue[cell] - ((Tables.RsqrtSlope[cell] * (uint)((m >> 40) & 0xffff)) >> 6);
                ulong y0 = seed;
                Wide square = Wide.Multiply(m, y0 * y0);
                ulong e = 0 - ((square.High << 16) | (square.Low >> 48));
                ulong factor = Tables.RsqrtC2 + (Wide.MultiplyHigh(Tables.RsqrtC3, e) >> 14);
                ulong correction = e + (Wide.MultiplyHigh(Wide.MultiplyHigh(e, e), factor) >> 13);
                ulong y = (y0 << 32) + ((Wide.MultiplyHigh(correction, y0 << 32) + (1u << 14)) >> 15);
                return y - ((y >> 63) ^ 1);
            }
        }

        /// <summary>The integer nearest to sqrt(n), from a guess, however bad.</summary>
        internal static ulong NearestRoot(Wide nLessGuessSquared, ulong guess)
        {
            Wide d = nLessGuessSquared;
            ulong s = guess;
            while (!d.IsNegative && (d.High != 0 || d.Low > s))  // (s + 1/2)^2 < n
            {
                d = d - new Wide(0, s) - new Wide(0, s + 1);
                ++s;
            }
            for (;;)  // n < (s - 1/2)^2
            {
                Wide sum = d + new Wide(0, s);
                if (!sum.IsNegative && !sum.IsZero) return s;
                d = sum + new Wide(0, s - 1);
                --s;
            }
        }

        /// <summary>The root of a raw number with `fraction` bits, to nearest; 0 of a negative one.</summary>
        internal static long Sqrt(long raw, int fraction)
        {
            if (raw <= 0) return 0;
            ulong u = (ulong)raw;
            int zeros = Wide.LeadingZeros(u);
            int k = zeros - ((zeros ^ fraction) & 1);  // makes the exponent of 2 under the root even
            ulong m = u << k;
            ulong root = Wide.MultiplyHigh(m, RsqrtQ64(m));
            ulong guess = Wide.ShiftRightRounded(root, 62 - (62 - k + fraction) / 2);
            Wide n = Wide.Multiply(u, 1UL << fraction);
            return (long)NearestRoot(n - Wide.Multiply(guess, guess), guess);
        }

        /// <summary>The reciprocal root; `highest` of zero, a negative number and where it does not fit.</summary>
        internal static long Rsqrt(long raw, int fraction, long highest)
        {
            if (raw <= 0) return highest;
            ulong u = (ulong)raw;
            int zeros = Wide.LeadingZeros(u);
            int k = zeros - ((zeros ^ fraction) & 1);
            int shift = 64 - (3 * fraction - 62 + k) / 2;
            if (shift < 0) return highest;
            ulong r = Wide.ShiftRightRounded(RsqrtQ64(u << k), shift);
            return r < (ulong)highest ? (long)r : highest;
        }

        internal static Wide Squared(long a)
        {
            ulong size = Wide.Magnitude(a);
            return Wide.Multiply(size, size);
        }
    }
}
