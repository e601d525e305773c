// 128-bit integers, modulo 2^128: the exact products behind 64-bit fixed point.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    /// <summary>An integer in two's complement in two words, signed or unsigned as the operation says.</summary>
    internal struct Wide
    {
        internal ulong High;
        internal ulong Low;

        internal Wide(ulong high, ulong low)
        {
            High = high;
            Low = low;
        }

        internal static Wide FromSigned(long value) =>
            new Wide(unchecked((ulong)(value >> 63)), unchecked((ulong)value));

        internal bool IsZero => (High | Low) == 0;
        internal bool IsNegative => High >> 63 != 0;

        public static Wide operator +(Wide a, Wide b)
        {
            unchecked
            {
                ulong low = a.Low + b.Low;
                return new Wide(a.High + b.High + (low < a.Low ? 1u : 0u), low);
            }
        }

        public static Wide operator -(Wide a, Wide b)
        {
            unchecked { return new Wide(a.High - b.High - (a.Low < b.Low ? 1u : 0u), a.Low - b.Low); }
        }

        public static Wide operator -(Wide a) => new Wide(0, 0) - a;

        /// <summary>Shifts left, 0 &lt;= n &lt; 128.</summary>
        public static Wide operator <<(Wide a, int n)
        {
            if (n >= 64) return new Wide(a.Low << (n - 64), 0);
            return new Wide((a.High << n) | ((a.Low >> 1) >> (63 - n)), a.Low << n);
        }

        /// <summary>Shifts unsigned, 0 &lt;= n &lt; 128.</summary>
        internal static Wide ShiftRight(Wide a, int n)
        {
            if (n >= 64) return new Wide(0, a.High >> (n - 64));
            return new Wide(a.High >> n, (a.Low >> n) | ((a.High << 1) << (63 - n)));
        }

        /// <summary>Shifts signed, 0 &lt; n &lt; 64, and returns the low word of the shifted number.</summary>
        internal static long ShiftRightToLong(Wide a, int n)
        {
            return unchecked((long)((a.Low >> n) | ((a.High << 1) << (63 - n))));
        }

        /// <summary>The full product of two unsigned numbers, by four partial products.</summary>
        internal static Wide Multiply(ulong a, ulong b)
        {
            unchecked
            {
                ulong lowLow = (ulong)(uint)a * (uint)b;
                ulong lowHigh = (uint)a * (b >> 32);
                ulong highLow = (a >> 32) * (uint)b;
                ulong middle = (lowLow >> 32) + (uint)lowHigh + (uint)highLow;
                ulong high = (a >> 32) * (b >> 32) + (lowHigh >> 32) + (highLow >> 32) + (middle >> 32);
                return new Wide(high, (middle << 32) | (uint)lowLow);
            }
        }

        internal static ulong MultiplyHigh(ulong a, ulong b)
        {
            unchecked
            {
                ulong lowLow = (ulong)(uint)a * (uint)b;
                ulong lowHigh = (uint)a * (b >> 32);
                ulong highLow = (a >> 32) * (uint)b;
                ulong middle = (lowLow >> 32) + (uint)lowHigh + (uint)highLow;
                return (a >> 32) * (b >> 32) + (lowHigh >> 32) + (highLow >> 32) + (middle >> 32);
            }
        }

        /// <summary>The full product of two signed numbers.</summary>
        internal static Wide Multiply(long a, long b)
        {
            unchecked
            {
                Wide product = Multiply((ulong)a, (ulong)b);
                product.High -= ((ulong)(a >> 63) & (ulong)b) + ((ulong)(b >> 63) & (ulong)a);
                return product;
            }
        }

        /// <summary>The upper half of a 256-bit product, less at most 3 units.</summary>
        internal static Wide MultiplyHigh(Wide a, Wide b)
        {
            Wide middle = new Wide(0, MultiplyHigh(a.High, b.Low)) + new Wide(0, MultiplyHigh(a.Low, b.High));
            return Multiply(a.High, b.High) + middle;
        }

        /// <summary>Returns a b / 2^64.</summary>
        internal static Wide MultiplyHigh(Wide a, ulong b)
        {
            return Multiply(a.High, b) + new Wide(0, MultiplyHigh(a.Low, b));
        }

        /// <summary>The leading zero bits of a number that is not 0.</summary>
        internal static int LeadingZeros(ulong a)
        {
            int zeros = 0;
            if (a >> 32 == 0) { zeros += 32; a <<= 32; }
            if (a >> 48 == 0) { zeros += 16; a <<= 16; }
            if (a >> 56 == 0) { zeros += 8; a <<= 8; }
            if (a >> 60 == 0) { zeros += 4; a <<= 4; }
            if (a >> 62 == 0) { zeros += 2; a <<= 2; }
            return a >> 63 == 0 ? zeros + 1 : zeros;
        }

        internal static int LeadingZeros(Wide a)
        {
            return a.High != 0 ? LeadingZeros(a.High) : 64 + LeadingZeros(a.Low);
        }

        /// <summary>Returns a / 2^n to nearest, ties up, n >= 0.</summary>
        internal static ulong ShiftRightRounded(ulong a, int n)
        {
            if (n == 0) return a;
            if (n > 64) return 0;
            ulong twice = a >> (n - 1);
            return (twice >> 1) + (twice & 1);
        }

        internal static ulong Magnitude(long value) => unchecked(value < 0 ? 0 - (ulong)value : (ulong)value);

        /// <summary>The quotient, rounded down, of an unsigned number whose upper word is below the divisor.</summary>
        /// <remarks>Source: Knuth, The Art of Computer Programming 2, 3rd ed., sec. 4.3.1, algorithm D, with two
        /// digits of 32 bits.</remarks>
        internal static ulong Divide(Wide numerator, ulong divisor, out ulong remainder)
        {
            unchecked
            {
                int shift = LeadingZeros(divisor);
                ulong d = divisor << shift;
                Wide n = numerator << shift;
                ulong dHigh = d >> 32, dLow = (uint)d;
                ulong first = DivideDigit(n.High, n.Low >> 32, dHigh, dLow);
                ulong rest = (n.High << 32) + (n.Low >> 32) - first * d;
                ulong second = DivideDigit(rest, (uint)n.Low, dHigh, dLow);
                remainder = ((rest << 32) + (uint)n.Low - second * d) >> shift;
                return (first << 32) + second;
            }
        }

        /// <summary>Returns floor((high 2^32 + next) / (dHigh 2^32 + dLow)), high below the divisor, whose top bit
        /// is set.</summary>
        private static ulong DivideDigit(ulong high, ulong next, ulong dHigh, ulong dLow)
        {
            unchecked
            {
                ulong digit = high / dHigh;
                ulong rest = high - digit * dHigh;
                while (digit >> 32 != 0 || digit * dLow > ((rest << 32) | next))
                {
                    --digit;
                    rest += dHigh;
                    if (rest >> 32 != 0) break;
                }
                return digit;
            }
        }
    }
}
