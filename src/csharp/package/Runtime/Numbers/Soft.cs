// A number as integer mantissa and exponent: the form in which the elementary functions meet every format.
// SPDX-License-Identifier: MIT
namespace Isostep
{
    /// <summary>The number Mantissa 2^Exponent, negated if Negative.</summary>
    internal struct Soft
    {
        internal ulong Mantissa;
        internal int Exponent;
        internal bool Negative;

        internal Soft(ulong mantissa, int exponent, bool negative)
        {
            Mantissa = mantissa;
            Exponent = exponent;
            Negative = negative;
        }

        internal static Soft FromFixed(long raw, int fraction) =>
            new Soft(Wide.Magnitude(raw), -fraction, raw < 0);

        /// <summary>The mantissa's top bit at bit 63; zero stays as it is.</summary>
        internal Soft Normalised()
        {
            if (Mantissa == 0) return this;
            int zeros = Wide.LeadingZeros(Mantissa);
            return new Soft(Mantissa << zeros, Exponent - zeros, Negative);
        }

        /// <summary>A count of 2^-bits, to nearest; what does not fit becomes the largest.</summary>
        internal ulong MagnitudeInUnits(int bits)
        {
            int left = Exponent + bits;
            if (left <= 0) return Wide.ShiftRightRounded(Mantissa, -left);
            if (Mantissa == 0) return 0;
            return left <= Wide.LeadingZeros(Mantissa) ? Mantissa << left : ulong.MaxValue;
        }

        /// <summary>Converts to nearest; outside the range to the format's end.</summary>
        internal long ToFixed(int fraction, long highest)
        {
            ulong units = MagnitudeInUnits(fraction);
            long raw = units < (ulong)highest ? (long)units : highest;
            return Negative ? -raw : raw;
        }

        /// <summary>The square root, relative error below 2^-60.</summary>
        internal Soft Sqrt()
        {
            if (Mantissa == 0) return this;
            Soft n = Normalised();
            int odd = n.Exponent & 1;
            ulong m = n.Mantissa >> odd;
            return new Soft(Wide.MultiplyHigh(m, Roots.RsqrtQ64(m)), (n.Exponent + odd + 62) / 2 - 62, false);
        }
    }

    /// <summary>A Soft whose mantissa has 128 bits.</summary>
    internal struct WideSoft
    {
        internal Wide Mantissa;
        internal int Exponent;
        internal bool Negative;

        internal WideSoft(Wide mantissa, int exponent, bool negative)
        {
            Mantissa = mantissa;
            Exponent = exponent;
            Negative = negative;
        }

        internal static WideSoft FromFixed(long raw, int fraction)
        {
            return new WideSoft(new Wide(Wide.Magnitude(raw), 0), -fraction - 64, raw < 0);
        }

        internal WideSoft Normalised()
        {
            if (Mantissa.IsZero) return this;
            int zeros = Wide.LeadingZeros(Mantissa);
            return new WideSoft(Mantissa << zeros, Exponent - zeros, Negative);
        }

        internal long ToFixed(int fraction, long highest)
        {
            WideSoft n = Normalised();
            return new Soft(n.Mantissa.High, n.Exponent + 64, n.Negative).ToFixed(fraction, highest);
        }
    }
}
