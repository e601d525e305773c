// Decimal text of fixed point and back, exact both ways, whatever the culture.
// SPDX-License-Identifier: MIT
using System.Globalization;
using System.Text;

namespace Isostep
{
    internal static class DecimalText
    {
        /// <summary>The decimal of fewest digits that Read returns to the same number.</summary>
        /// <remarks>Source: Steele, White 1990, How to Print Floating-Point Numbers Accurately, PLDI, (FP)^2.</remarks>
        internal static string Write(long raw, int fraction)
        {
            StringBuilder text = new StringBuilder(raw < 0 ? "-" : "");
            ulong magnitude = Wide.Magnitude(raw);
            text.Append((magnitude >> fraction).ToString(CultureInfo.InvariantCulture));
            ulong rest = magnitude << (64 - fraction);
            ulong slack = 1UL << (63 - fraction);
            if (rest == 0) return text.ToString();
            text.Append('.');
            for (;;)
            {
                Wide step = Wide.Multiply(rest, 10UL);
                Wide wider = Wide.Multiply(slack, 10UL);
                rest = step.Low;
                slack = wider.High != 0 ? ulong.MaxValue : wider.Low;
                ulong missing = unchecked(0 - rest);
                bool down = rest <= slack;
                bool up = rest != 0 && missing < slack;
                bool higher = up && (!down || missing < rest);
                text.Append((char)('0' + (int)step.High + (higher ? 1 : 0)));
                if (down || up) return text.ToString();
            }
        }

        /// <summary>Reads -?digits(.digits)?, nothing else: to nearest, ties away from zero. False: not that, or
        /// out of the format's range.</summary>
        internal static bool Read(string text, int fraction, int bits, out long raw)
        {
            raw = 0;
            if (text == null) return false;
            int at = text.Length > 0 && text[0] == '-' ? 1 : 0;
            bool negative = at == 1;
            ulong whole;
            if (!ReadWhole(text, ref at, out whole)) return false;
            ulong part = 0;
            if (at < text.Length)
            {
                if (text[at] != '.' || at + 1 == text.Length) return false;
                byte[] digits = new byte[text.Length - at - 1];
                for (int i = 0; i < digits.Length; ++i)
                {
                    char c = text[at + 1 + i];
                    if (c < '0' || c > '9') return false;
                    digits[i] = (byte)(c - '0');
                }
                part = ReadFraction(digits);
            }
            ulong limit = (1UL << (bits - 1)) - (negative ? 0u : 1u);
            if (whole > limit >> fraction) return false;
            ulong magnitude = (whole << fraction) | (part >> (64 - fraction));
            if (magnitude > limit) return false;
            magnitude += (part >> (63 - fraction)) & 1;
            if (magnitude > limit) return false;
            raw = unchecked(negative ? -(long)magnitude : (long)magnitude);
            return true;
        }

        /// <summary>Reads digits up to 2^63, beyond every format; no zero stands before other digits.</summary>
        private static bool ReadWhole(string text, ref int at, out ulong whole)
        {
            whole = 0;
            int first = at;
            for (; at < text.Length && text[at] >= '0' && text[at] <= '9'; ++at)
            {
                whole = whole < 1UL << 59 ? whole * 10 + (ulong)(text[at] - '0') : 1UL << 63;
            }
            return at > first && (at == first + 1 || text[first] != '0');
        }

        /// <summary>Reads 0.digits in units of 2^-64, rounded down, bit by bit.</summary>
        private static ulong ReadFraction(byte[] digits)
        {
            ulong value = 0;
            for (int bit = 0; bit < 64; ++bit)
            {
                int carry = 0;
                for (int i = digits.Length; i-- > 0;)
                {
                    int doubled = digits[i] * 2 + carry;
                    carry = doubled >= 10 ? 1 : 0;
                    digits[i] = (byte)(doubled - 10 * carry);
                }
                value = (value << 1) | (uint)carry;
            }
            return value;
        }
    }
}
