// sin, cos, atan2, asin, acos of fixed point: the integers of isostep's scalar/math.inl.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    internal static class Circular
    {
        /// <summary>A whole number of quarter turns, of which the last two bits matter, and a fraction of one.
        /// </summary>
        private struct QuarterTurns
        {
            internal ulong Fraction;  // units of 2^-64
            internal uint Quadrant;

            /// <summary>The quarter turns of magnitude 2^-fraction: 128 digits of 2/pi times 64 bits.</summary>
            internal QuarterTurns(ulong magnitude, int fraction)
            {
                Wide product = Wide.Multiply(magnitude, Tables.TwoOverPi[2]) +
                               new Wide(0, Wide.MultiplyHigh(magnitude, Tables.TwoOverPi[3]));
                Fraction = (product << (64 - fraction)).High;
                Quadrant = unchecked((uint)Wide.ShiftRight(product, 64 + fraction).Low) & 3u;
            }
        }

        internal static long Sin(long raw, int fraction, int outFraction)
        {
            return Sine(new QuarterTurns(Wide.Magnitude(raw), fraction), 0, raw < 0, outFraction);
        }

        internal static long Cos(long raw, int fraction, int outFraction)
        {
            return Sine(new QuarterTurns(Wide.Magnitude(raw), fraction), 1, false, outFraction);
        }

        private static ulong QuarterWave(uint row, ulong t)
        {
            ulong[] c = row == 0 ? Tables.QuarterWaveSine : Tables.QuarterWaveCosine;
            ulong sum = c[7];
            for (int i = 6; i >= 0; --i) sum = unchecked(c[i] - Wide.MultiplyHigh(sum, t));
            return sum;
        }

        /// <summary>The sine of `turns` after `more` quarter turns, folded at an eighth of a turn.</summary>
        private static long Sine(QuarterTurns turns, uint more, bool negative, int outFraction)
        {
            uint quadrant = turns.Quadrant + more;
            bool fold = turns.Fraction >> 63 != 0;
            ulong f = fold ? unchecked(0 - turns.Fraction) : turns.Fraction;
            uint row = (quadrant & 1u) ^ (fold ? 1u : 0u);
            ulong wave = QuarterWave(row, Wide.MultiplyHigh(f, f));
            ulong value = row == 1 ? wave : Wide.MultiplyHigh(wave, f);
            long raw = (long)(((value >> (62 - outFraction)) + 1) >> 1);
            return ((quadrant & 2u) != 0) != negative ? -raw : raw;
        }

        /// <summary>Returns 2^63 atan(r) / r for t = r^2 in Q0.64, t at most 2^-13.</summary>
        private static ulong AtanSeries(ulong t)
        {
            const ulong unit = 1UL << 63;
            ulong sum = unit / 7 - Wide.MultiplyHigh(unit / 9, t);
            sum = unit / 5 - Wide.MultiplyHigh(sum, t);
            sum = unit / 3 - Wide.MultiplyHigh(sum, t);
            return unit - Wide.MultiplyHigh(sum, t);
        }

        /// <summary>Returns atan(a / b) for a 2^-gap &lt;= b, both mantissas in [2^62, 2^63).</summary>
        private static Soft AtanOfRatio(ulong a, ulong b, int gap)
        {
            unchecked
            {
                ulong unused;
                ulong aligned = gap < 63 ? a >> gap : 0;
                uint leading = (uint)(b >> 47);
                uint i = ((uint)(aligned >> 41) + leading / 2) / leading;
                if (i == 0)
                {
                    int halve = a >= b ? 1 : 0;
                    ulong ratio = Wide.Divide(new Wide(a >> halve, halve != 0 ? a << 63 : 0), b, out unused);
                    int down = gap - halve;
                    ulong small = down < 64 ? ratio >> down : 0;
                    ulong series = AtanSeries(Wide.MultiplyHigh(small, small));
                    return new Soft(Wide.MultiplyHigh(ratio, series), -63 - down, false);
                }
                ulong a64 = gap <= 6 ? a << (6 - gap) : a >> 1;
                long numerator = (long)(a64 - i * b);
                ulong denominator = b + (Wide.MultiplyHigh(aligned, (ulong)i << 57) << 1);
                ulong q = Wide.Divide(new Wide(Wide.Magnitude(numerator), 0), denominator, out unused);
                ulong r = q >> 6;
                int octave = 63 - Wide.LeadingZeros(i);
                ulong atan = Wide.MultiplyHigh(q, AtanSeries(Wide.MultiplyHigh(r, r))) >> octave;
                ulong angle = numerator < 0 ? Tables.Atan64ths[i] - atan : Tables.Atan64ths[i] + atan;
                return new Soft(angle, octave - 69, false);
            }
        }

        private static Soft Atan2(Soft y, Soft x)
        {
            if (y.Mantissa == 0) return new Soft(x.Negative ? Tables.PiQ62 : 0, -62, y.Negative);
            if (x.Mantissa == 0) return new Soft(Tables.HalfPiQ62, -62, y.Negative);
            Soft v = y.Normalised();
            Soft u = x.Normalised();
            bool steep = v.Exponent > u.Exponent || (v.Exponent == u.Exponent && v.Mantissa > u.Mantissa);
            Soft small = steep ? u : v;
            Soft large = steep ? v : u;
            Soft angle = AtanOfRatio(small.Mantissa >> 1, large.Mantissa >> 1, large.Exponent - small.Exponent);
            if (steep || x.Negative)
            {
                ulong units = angle.MagnitudeInUnits(62);
                ulong from = steep ? Tables.HalfPiQ62 : Tables.PiQ62;
                angle = new Soft(steep && x.Negative ? from + units : from - units, -62, false);
            }
            angle.Negative = y.Negative;
            return angle;
        }

        /// <summary>Returns sqrt(1 - x^2) for |x| &lt; 1, as sqrt((1 - x)(1 + x)).</summary>
        private static Soft OtherLeg(Soft x)
        {
            ulong size = x.MagnitudeInUnits(64);
            ulong minus = size != 0 ? unchecked(0 - size) : ulong.MaxValue;
            ulong plus = (1UL << 63) + (size >> 1);
            int zeros = Wide.LeadingZeros(minus);
            return new Soft(Wide.MultiplyHigh(minus << zeros, plus), -63 - zeros, false).Sqrt();
        }

        private static bool AtLeastOne(Soft a)
        {
            Soft n = a.Normalised();
            return n.Mantissa != 0 && n.Exponent >= -63;
        }

        internal static long Atan2(long y, long x, int fraction, int outFraction, long highest)
        {
            return Atan2(Soft.FromFixed(y, fraction), Soft.FromFixed(x, fraction)).ToFixed(outFraction, highest);
        }

        internal static long Asin(long raw, int fraction, long highest)
        {
            Soft x = Soft.FromFixed(raw, fraction);
            Soft angle = AtLeastOne(x) ? new Soft(Tables.HalfPiQ62, -62, x.Negative) : Atan2(x, OtherLeg(x));
            return angle.ToFixed(fraction, highest);
        }

        internal static long Acos(long raw, int fraction, long highest)
        {
            Soft x = Soft.FromFixed(raw, fraction);
            Soft angle = !AtLeastOne(x) ? Atan2(OtherLeg(x), x)
                : x.Negative ? new Soft(Tables.PiQ62, -62, false) : new Soft(0, 0, false);
            return angle.ToFixed(fraction, highest);
        }
    }
}
