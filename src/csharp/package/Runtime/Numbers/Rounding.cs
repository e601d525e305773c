// Exact sums of products to fixed-point numbers, and quotients: one rounding each.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    internal static class Rounding
    {
        internal static long Product(int a, int b) => (long)a * b;

        internal static Wide Product(long a, long b) => Wide.Multiply(a, b);

        /// <summary>Rounds sum / 2^shift to nearest, ties towards plus infinity; wraps beyond. 0 &lt; shift.
        /// </summary>
        internal static int Round(long sum, int shift) =>
            unchecked((int)((sum + (1L << (shift - 1))) >> shift));

        /// <summary>Rounds a wide sum in the same way, shift &lt; 64.</summary>
        internal static long Round(Wide sum, int shift)
        {
            return Wide.ShiftRightToLong(sum + new Wide(0, 1UL << (shift - 1)), shift);
        }

        /// <summary>Returns a 2^shift / b to nearest, ties away from zero. It saturates: x / 0 to x's end, 0 / 0 is 0.
        /// </summary>
        internal static int Divide(int a, int b, int shift)
        {
            if (b == 0) return a == 0 ? 0 : a < 0 ? int.MinValue : int.MaxValue;
            ulong n = Wide.Magnitude(a) << shift, d = Wide.Magnitude(b);  // shift at most 32
            ulong quotient = n / d;
            ulong remainder = n - quotient * d;
            if (remainder >= d - remainder) ++quotient;
            bool negative = (a < 0) != (b < 0);
            if (quotient > int.MaxValue) return negative ? int.MinValue : int.MaxValue;
            return negative ? -(int)quotient : (int)quotient;
        }

        internal static long Divide(long a, long b, int shift)
        {
            if (b == 0) return a == 0 ? 0 : a < 0 ? long.MinValue : long.MaxValue;
            bool negative = (a < 0) != (b < 0);
            Wide n = new Wide(0, Wide.Magnitude(a)) << shift;
            ulong d = Wide.Magnitude(b);
            ulong quotient = ulong.MaxValue;
            if (n.High < d)
            {
                ulong remainder;
                quotient = Wide.Divide(n, d, out remainder);
                if (remainder >= d - remainder && quotient < 1UL << 63) ++quotient;
            }
            if (quotient > long.MaxValue) return negative ? long.MinValue : long.MaxValue;
            return negative ? -(long)quotient : (long)quotient;
        }

        /// <summary>A whole number with `fraction` bits behind the point, or the nearest end.</summary>
        internal static long FromWhole(long whole, int fraction, long lowest, long highest)
        {
            long most = highest >> fraction;
            return whole > most ? highest : whole < -most - 1 ? lowest : whole << fraction;
        }

        /// <summary>Converts to nearest, ties away from zero; outside the range to the nearest end, NaN to 0.</summary>
        internal static long FromDouble(double value, int fraction, int bits)
        {
            double scaled = value * TwoTo(fraction);  // exact, or infinite
            double limit = TwoTo(bits - 1);
            long highest = long.MaxValue >> (64 - bits), lowest = long.MinValue >> (64 - bits);
            if (double.IsNaN(scaled)) return 0;
            if (scaled >= limit - 0.5) return highest;
            if (scaled <= -limit) return lowest;
            double size = scaled < 0 ? -scaled : scaled;
            long whole = (long)size;
            if (size - whole >= 0.5) ++whole;
            return scaled < 0 ? -whole : whole;
        }

        internal static double ToDouble(long raw, int fraction) => raw / TwoTo(fraction);

        private static double TwoTo(int n)  // exact, n < 64
        {
            double power = 1;
            for (int i = 0; i < n; ++i) power *= 2;
            return power;
        }
    }
}
