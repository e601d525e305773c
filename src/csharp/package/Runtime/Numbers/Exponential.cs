// exp, log and powers of fixed point: the integers of isostep's scalar/exp_log.inl, rounded once.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    internal static class Exponential
    {
        /// <summary>e^x. a / ln 2 = n + i/64 + r; e^a = 2^n (T + T (2^r - 1)), T = 2^(i/64).</summary>
        private static WideSoft Exp(WideSoft x)
        {
            unchecked
            {
                Wide one = new Wide(1UL << 63, 0);
                WideSoft a = x.Normalised();
                if (a.Mantissa.IsZero) return new WideSoft(one, -127, false);
                if (a.Exponent > 12 - 128) return new WideSoft(a.Negative ? new Wide(0, 0) : one, 1 << 13, false);
                int down = -(a.Exponent + 113);
                Wide size = new Wide(0, 0);
                if (down < 128) size = Wide.ShiftRight(Wide.MultiplyHigh(a.Mantissa, Tables.Log2E), down);
                Wide y = a.Negative ? new Wide(0, 0) - size : size;
                int n = (int)((long)y.High >> 48);
                Wide power = Tables.Exp2Of64ths[(int)((y.High >> 42) & 63)];
                Wide u = y << 22;
                ulong sum = Tables.ExpSeries[5];
                for (int i = 4; i >= 0; --i) sum = Tables.ExpSeries[i] + Wide.MultiplyHigh(sum, u.High);
                Wide slope = Tables.Ln2Q128 + Wide.ShiftRight(Wide.Multiply(sum, u.High), 6);
                Wide rise = Wide.ShiftRight(Wide.MultiplyHigh(power, Wide.MultiplyHigh(slope, u)), 7);
                return new WideSoft(Wide.ShiftRight(power, 1) + rise, n - 126, false);
            }
        }

        /// <summary>ln x for x > 0. x = 2^k m; ln x = k ln 2 - ln R + ln(1 + r), r = m R - 1 exact.</summary>
        private static WideSoft Log(Soft x)
        {
            unchecked
            {
                Soft n = x.Normalised();
                int cell = (int)(((n.Mantissa >> 56) - 127) >> 1);
                Wide whole = TimesLn2(n.Exponent + 63) + Tables.LogOfCell[cell];
                Wide product = Wide.Multiply(n.Mantissa, Tables.ReciprocalOfCell[cell]);
                Wide one = new Wide(1UL << 15, 0);
                bool below = product.High < one.High;
                Wide d = below ? one - product : product - one;
                WideSoft small = new WideSoft(new Wide(0, 0), -116, false);
                if (!d.IsZero) small = LogOfOnePlus(d, below);
                if (whole.IsZero) return small;
                Wide rest = Wide.ShiftRight(small.Mantissa, -116 - small.Exponent);
                Wide total = small.Negative ? whole - rest : whole + rest;
                bool negative = total.IsNegative;
                return new WideSoft(negative ? -total : total, -116, negative);
            }
        }

        /// <summary>Returns k ln 2 in units of 2^-116.</summary>
        private static Wide TimesLn2(int k)
        {
            unchecked
            {
                ulong size = (ulong)(k < 0 ? -k : k);
                Wide product = Wide.Multiply(Tables.Ln2Q116.Low, size);
                product.High += Tables.Ln2Q116.High * size;
                return k < 0 ? -product : product;
            }
        }

        /// <summary>ln(1 + r), |r| = d 2^-79 &lt; 1/127, negative if below: r - r^2 series(r).</summary>
        private static WideSoft LogOfOnePlus(Wide d, bool below)
        {
            unchecked
            {
                int zeros = Wide.LeadingZeros(d);
                int octave = zeros - 48;
                Wide r = d << zeros;
                ulong u = Wide.ShiftRight(d, 9).Low;  // 64 |r|
                ulong sum = Tables.LogSeries[7];
                for (int i = 6; i >= 0; --i)
                {
                    ulong term = Wide.MultiplyHigh(sum, u);
                    sum = below ? Tables.LogSeries[i] + term : Tables.LogSeries[i] - term;
                }
                Wide bend = Wide.ShiftRight(Wide.Multiply(Wide.MultiplyHigh(r.High, r.High), sum), octave);
                Wide line = Wide.ShiftRight(r, 1);
                return new WideSoft(below ? line + bend : line - bend, -126 - octave, below);
            }
        }

        internal static long Exp(long raw, int fraction, long highest)
        {
            return Exp(WideSoft.FromFixed(raw, fraction)).ToFixed(fraction, highest);
        }

        internal static long Log(long raw, int fraction, long lowest, long highest)
        {
            return raw <= 0 ? lowest : Log(Soft.FromFixed(raw, fraction)).ToFixed(fraction, highest);
        }

        /// <summary>The power base^exponent; a negative base counts as zero.</summary>
        internal static long Pow(long raw, long exponent, int fraction, long highest)
        {
            if (raw <= 0)
            {
                if (exponent > 0) return 0;
                return exponent < 0 ? highest : Exp(0, fraction, highest);
            }
            WideSoft log = Log(Soft.FromFixed(raw, fraction)).Normalised();
            Soft h = Soft.FromFixed(exponent, fraction).Normalised();
            WideSoft product = new WideSoft(Wide.MultiplyHigh(log.Mantissa, h.Mantissa), log.Exponent + h.Exponent + 64,
                log.Negative != h.Negative);
            return Exp(product).ToFixed(fraction, highest);
        }
    }
}
