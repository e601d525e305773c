// Decimal text both ways by integers alone: reading expands the decimal into binary words, writing is Steele & White.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <ostream>

namespace isostep::detail {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number as it is written: the digits of whole and fraction in a row, the first and last of them not zero.
/// Value = 0.d1 d2 d3 ... times 10^point.
struct Decimal {
  bool negative = false;
  std::string_view whole;
  std::string_view fraction;
  std::int64_t first = 0;  // index of the first digit that is not zero, whole and fraction taken as one text
  std::int64_t last = 0;   // one past the last digit that is not zero; first == last is the number zero
  std::int64_t point = 0;

  /// The digit worth 10^(-position - 1); zero where nothing is written.
  std::uint32_t at(std::int64_t position) const {
    const std::int64_t i = position + point + first;
    if (i < first || i >= last) return 0;
    const auto size = static_cast<std::int64_t>(whole.size());
    return static_cast<std::uint32_t>(i < size ? whole[static_cast<std::size_t>(i)] - '0'
                                               : fraction[static_cast<std::size_t>(i - size)] - '0');
  }
};

std::string_view take_digits(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  const std::string_view digits = text.substr(0, n);
  text.remove_prefix(n);
  return digits;
}
bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

/// RFC 8259, section 6: -?(0|[1-9][0-9]*)(.[0-9]+)?([eE][+-]?[0-9]+)? and nothing before or after.
bool scan(std::string_view text, Decimal& number) {
  number.negative = take(text, '-');
  number.whole = take_digits(text);
  if (number.whole.empty() || (number.whole.size() > 1 && number.whole.front() == '0')) return false;
  if (take(text, '.')) {
    number.fraction = take_digits(text);
    if (number.fraction.empty()) return false;
  }
  std::int64_t exponent = 0;
  if (take(text, 'e') || take(text, 'E')) {
    const bool negative = take(text, '-');
    if (!negative) take(text, '+');
    const std::string_view digits = take_digits(text);
    if (digits.empty()) return false;
    constexpr std::int64_t kEndless = std::int64_t{1} << 56;  // no text is long enough to bring such a number back
    for (const char c : digits) exponent = std::min(kEndless, exponent * 10 + (c - '0'));
    if (negative) exponent = -exponent;
  }
  if (!text.empty()) return false;

  const auto size = static_cast<std::int64_t>(number.whole.size());
  const std::int64_t count = size + static_cast<std::int64_t>(number.fraction.size());
  number.last = count;
  const auto digit = [&](std::int64_t i) { return number.at(i - number.point - number.first); };
  while (number.first < count && digit(number.first) == 0) ++number.first;
  while (number.last > number.first && digit(number.last - 1) == 0) --number.last;
  number.point = size - number.first + exponent;
  return true;
}

constexpr std::uint32_t kBillion = 1000000000;

/// A decimal's whole part and fraction in base 10^9, from which binary words are drawn.
/// Sizes: a double's whole part has at most 309 digits, its ties end at digit 1075; what lies further only is `sticky`.
class Expansion {
 public:
  static constexpr int kWholeLimbs = 35;
  static constexpr int kFractionLimbs = 120;

  explicit Expansion(const Decimal& number) {
    const auto limb = [&](std::int64_t start) {
      std::uint32_t value = 0;
      for (int i = 0; i < 9; ++i) value = value * 10 + number.at(start + i);
      return value;
    };
    for (std::int64_t start = 0; start < number.point && whole_size_ < kWholeLimbs; start += 9) {
      whole_[static_cast<std::size_t>(whole_size_++)] = limb(-start - 9);
    }
    const std::int64_t digits = number.last - number.first - number.point;  // written behind the point
    sticky_ = digits > kFractionLimbs * 9;
    const std::int64_t limbs = std::min<std::int64_t>(kFractionLimbs, (std::max<std::int64_t>(digits, 0) + 8) / 9);
    for (; fraction_size_ < limbs; ++fraction_size_) {
      fraction_[static_cast<std::size_t>(fraction_size_)] = limb(fraction_size_ * 9);
    }
  }

  /// The lowest 32 bits of the whole part, which is divided by 2^32.
  std::uint32_t take_whole_word() {
    std::uint64_t remainder = 0;
    for (int i = whole_size_; i-- > 0;) {
      const std::uint64_t value = remainder * kBillion + whole_[static_cast<std::size_t>(i)];
      whole_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(value >> 32);
      remainder = value & 0xffffffffu;
    }
    while (whole_size_ > 0 && whole_[static_cast<std::size_t>(whole_size_ - 1)] == 0) --whole_size_;
    return static_cast<std::uint32_t>(remainder);
  }
  /// The highest 32 bits of the fraction, which is multiplied by 2^32.
  std::uint32_t take_fraction_word() {
    std::uint64_t carry = 0;
    for (int i = fraction_size_; i-- > 0;) {
      const std::uint64_t value = (std::uint64_t{fraction_[static_cast<std::size_t>(i)]} << 32) + carry;
      carry = value / kBillion;
      fraction_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(value - carry * kBillion);
    }
    while (fraction_size_ > 0 && fraction_[static_cast<std::size_t>(fraction_size_ - 1)] == 0) --fraction_size_;
    return static_cast<std::uint32_t>(carry);
  }
  bool has_whole() const { return whole_size_ > 0; }
  bool has_fraction() const { return fraction_size_ > 0 || sticky_; }

 private:
  std::array<std::uint32_t, kWholeLimbs> whole_{};        // lowest limb first
  std::array<std::uint32_t, kFractionLimbs> fraction_{};  // highest limb first
  int whole_size_ = 0;
  int fraction_size_ = 0;
  bool sticky_ = false;
};

/// Binary words of a number, highest first, with the point behind word `whole`.
struct Words {
  static constexpr int kCapacity = 72;
  std::array<std::uint32_t, kCapacity> word{};
  int whole = 0;
  int size = 0;

  bool bit(int exponent) const {  // the bit worth 2^exponent
    const int i = whole * 32 - 1 - exponent;
    if (i < 0 || i >= size * 32) return false;
    return ((word[static_cast<std::size_t>(i / 32)] >> (31 - i % 32)) & 1u) != 0;
  }
  int top() const {  // exponent of the highest bit; some bit is set
    int i = 0;
    while (word[static_cast<std::size_t>(i)] == 0) ++i;
    return (whole - i) * 32 - 1 - std::countl_zero(word[static_cast<std::size_t>(i)]);
  }
  bool any_below(int exponent) const {  // a bit worth less than 2^exponent
    for (int e = exponent - 1; e >= (whole - size) * 32; --e) {
      if (bit(e)) return true;
    }
    return false;
  }
};

/// All words of the whole part, then fraction words until `significant` bits follow the highest one or 2^lowest is
/// passed. At most 35 + 35 words.
Words words_of(Expansion& expansion, int significant, int lowest) {
  Words result;
  while (expansion.has_whole()) result.word[static_cast<std::size_t>(result.whole++)] = expansion.take_whole_word();
  std::reverse(result.word.begin(), result.word.begin() + result.whole);
  result.size = result.whole;
  bool started = result.whole > 0;
  int bits = 0;
  while (expansion.has_fraction() && bits < significant && (result.size - result.whole) * 32 < -lowest) {
    const std::uint32_t word = expansion.take_fraction_word();
    result.word[static_cast<std::size_t>(result.size++)] = word;
    if (started) bits += 32;
    started = started || word != 0;
  }
  return result;
}

std::uint64_t low_bits(int n) { return (std::uint64_t{1} << n) - 1; }

}  // namespace

TextError read_fixed(std::string_view text, int bits, int frac_bits, std::int64_t& raw) {
  Decimal number;
  if (!scan(text, number)) return TextError::not_a_number;
  raw = 0;
  if (number.first == number.last || number.point < -64) return TextError::none;  // 10^-65 < 2^-65
  if (number.point > 19) return TextError::out_of_range;                          // 10^19 > 2^63

  Expansion expansion(number);
  const std::uint64_t low = expansion.take_whole_word();
  const std::uint64_t whole = low | std::uint64_t{expansion.take_whole_word()} << 32;
  const std::uint64_t high = expansion.take_fraction_word();
  const std::uint64_t fraction = high << 32 | expansion.take_fraction_word();
  // A tie is a multiple of 2^-(F + 1) and F < 64: the bit behind the last one alone decides when ties leave zero.
  const std::uint64_t up = (fraction >> (63 - frac_bits)) & 1u;
  const std::uint64_t limit = (std::uint64_t{1} << (bits - 1)) - (number.negative ? 0 : 1);
  if (whole > limit >> frac_bits) return TextError::out_of_range;
  std::uint64_t magnitude = whole << frac_bits | fraction >> (64 - frac_bits);
  if (magnitude > limit) return TextError::out_of_range;
  magnitude += up;
  if (magnitude > limit) return TextError::out_of_range;
  raw = static_cast<std::int64_t>(number.negative ? 0 - magnitude : magnitude);
  return TextError::none;
}

TextError read_float(std::string_view text, FloatLayout format, std::uint64_t& bits) {
  Decimal number;
  if (!scan(text, number)) return TextError::not_a_number;
  const int stored = format.significand - 1;
  const int exponent_bits = format.significand == 24 ? 8 : 11;
  const std::uint64_t sign = std::uint64_t{number.negative} << (stored + exponent_bits);
  bits = sign;
  if (number.first == number.last || number.point < -330) return TextError::none;  // 10^-330 < 2^-1075
  if (number.point > 309) return TextError::out_of_range;                          // 10^309 > 2^1024

  Expansion expansion(number);
  const Words words = words_of(expansion, format.significand + 2, format.lowest_exponent - 2);
  if (!words.any_below(words.whole * 32)) return TextError::none;  // nothing down to half the smallest subnormal
  int last = std::max(words.top() - stored, format.lowest_exponent);
  std::uint64_t significand = 0;
  for (int i = stored; i >= 0; --i) significand = significand << 1 | (words.bit(last + i) ? 1u : 0u);
  const bool more = words.any_below(last - 1) || expansion.has_fraction();
  if (words.bit(last - 1) && (more || (significand & 1u) != 0)) ++significand;
  if (significand >> format.significand != 0) {
    significand >>= 1;
    ++last;
  }
  if (last > format.highest_exponent) return TextError::out_of_range;
  const bool normal = significand >> stored != 0;
  const std::uint64_t exponent = normal ? static_cast<std::uint64_t>(last - format.lowest_exponent + 1) : 0;
  bits = sign | exponent << stored | (significand & low_bits(stored));
  return TextError::none;
}

/// Source: Steele, White 1990, How to Print Floating-Point Numbers Accurately, PLDI, algorithm (FP)^2: digits until the
/// decimal so far, or that with its last digit one higher, lies where reading returns to the number.
/// Symbols: rest = what is still to be written, slack = half a raw unit, both over 2^64 = one of the current digit.
std::string text_of_fixed(std::uint64_t magnitude, bool negative, int frac_bits) {
  std::string result = negative ? "-" : "";
  result += std::to_string(magnitude >> frac_bits);
  std::uint64_t rest = magnitude << (64 - frac_bits);
  std::uint64_t slack = std::uint64_t{1} << (63 - frac_bits);
  if (rest == 0) return result;
  result += '.';
  for (;;) {
    const UInt128Parts step = multiply_portable(rest, 10);
    const UInt128Parts wider = multiply_portable(slack, 10);
    rest = step.low;
    slack = wider.high != 0 ? ~std::uint64_t{0} : wider.low;
    const std::uint64_t missing = 0 - rest;  // to the next digit, when rest is not zero
    const bool down = rest <= slack;         // half a unit below still reads back, half a unit above does not
    const bool up = rest != 0 && missing < slack;
    const bool higher = up && (!down || missing < rest);
    result += static_cast<char>('0' + step.high + (higher ? 1u : 0u));
    if (down || up) return result;
  }
}

namespace {

/// A natural number below 2^1280: enough for 10^308 beside four more bits, and for 2^1074 times 10^17.
class Natural {
 public:
  explicit Natural(std::uint64_t value) {
    word_[0] = static_cast<std::uint32_t>(value);
    word_[1] = static_cast<std::uint32_t>(value >> 32);
    size_ = word_[1] != 0 ? 2 : word_[0] != 0 ? 1 : 0;
  }
  Natural& operator*=(std::uint32_t factor) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      carry += std::uint64_t{word_[i]} * factor;
      word_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) word_[size_++] = static_cast<std::uint32_t>(carry);
    return *this;
  }
  Natural& scale_by_ten_to(int n) {
    for (; n >= 9; n -= 9) *this *= kBillion;
    for (; n > 0; --n) *this *= 10;
    return *this;
  }
  Natural& double_times(int n) {
    for (; n >= 31; n -= 31) *this *= std::uint32_t{1} << 31;
    return *this *= std::uint32_t{1} << n;
  }
  Natural& operator-=(const Natural& b) {  // b <= *this
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::uint64_t difference = std::uint64_t{word_[i]} - b.word_[i] - borrow;
      word_[i] = static_cast<std::uint32_t>(difference);
      borrow = difference >> 63;
    }
    while (size_ > 0 && word_[size_ - 1] == 0) --size_;
    return *this;
  }
  Natural& operator+=(const Natural& b) {
    size_ = std::max(size_, b.size_);
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      carry += std::uint64_t{word_[i]} + b.word_[i];
      word_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) word_[size_++] = static_cast<std::uint32_t>(carry);
    return *this;
  }
  friend int compare(const Natural& a, const Natural& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
    for (std::size_t i = a.size_; i-- > 0;) {
      if (a.word_[i] != b.word_[i]) return a.word_[i] < b.word_[i] ? -1 : 1;
    }
    return 0;
  }
  friend int compare_sum(Natural a, const Natural& b, const Natural& c) { return compare(a += b, c); }

 private:
  std::array<std::uint32_t, 40> word_{};
  std::size_t size_;
};

struct Digits {
  std::string text;
  int point;  // value = 0.text times 10^point
};

/// The shortest digits of significand 2^exponent, by the same algorithm over exact fractions rest / one.
/// `narrow`: the neighbour below is half as far as the one above. A tie reads back when the significand is even.
Digits shortest(std::uint64_t significand, int exponent, bool narrow) {
  const bool even = (significand & 1u) == 0;
  Natural rest(significand), one(1), below(1), above(1);
  // One factor of two for halves, one more where the lower half gap is a quarter.
  const int extra = narrow ? 2 : 1;
  rest.double_times(extra + std::max(exponent, 0));
  one.double_times(extra + std::max(-exponent, 0));
  below.double_times(std::max(exponent, 0));
  above.double_times(std::max(exponent, 0) + extra - 1);
  // 78913 / 2^18 is log10(2) from below, to 2e-6: the estimate is the point or up to two less.
  const int magnitude = exponent + 63 - std::countl_zero(significand);
  int point = static_cast<int>((std::int64_t{magnitude} * 78913) >> 18);
  if (point >= 0) one.scale_by_ten_to(point);
  if (point < 0) {
    rest.scale_by_ten_to(-point);
    below.scale_by_ten_to(-point);
    above.scale_by_ten_to(-point);
  }
  const auto reaches_one = [&] {
    const int order = compare_sum(rest, above, one);
    return even ? order >= 0 : order > 0;
  };
  while (reaches_one()) {
    one *= 10;
    ++point;
  }
  Digits result{{}, point};
  for (;;) {
    rest *= 10;
    below *= 10;
    above *= 10;
    int digit = 0;
    for (; compare(rest, one) >= 0; ++digit) rest -= one;
    const int order = compare(rest, below);
    const bool down = even ? order <= 0 : order < 0;
    const bool up = reaches_one();
    if (!down && !up) {
      result.text += static_cast<char>('0' + digit);
      continue;
    }
    const int half = compare_sum(rest, rest, one);
    const bool higher = up && (!down || half > 0 || (half == 0 && digit % 2 != 0));
    result.text += static_cast<char>('0' + digit + (higher ? 1 : 0));
    return result;
  }
}

std::string arrange(const Digits& digits) {
  const int count = static_cast<int>(digits.text.size());
  const auto zeros = [](int n) { return std::string(static_cast<std::size_t>(n), '0'); };
  if (digits.point > 21 || digits.point <= -6) {
    std::string result = digits.text.substr(0, 1);
    if (count > 1) result += '.' + digits.text.substr(1);
    return result + 'e' + std::to_string(digits.point - 1);
  }
  if (digits.point <= 0) return "0." + zeros(-digits.point) + digits.text;
  if (count <= digits.point) return digits.text + zeros(digits.point - count);
  const auto split = static_cast<std::size_t>(digits.point);
  return digits.text.substr(0, split) + '.' + digits.text.substr(split);
}

}  // namespace

std::string text_of_float(std::uint64_t bits, FloatLayout format) {
  const int stored = format.significand - 1;
  const int exponent_bits = format.significand == 24 ? 8 : 11;
  const std::string sign = (bits >> (stored + exponent_bits)) != 0 ? "-" : "";
  const std::uint64_t fraction = bits & low_bits(stored);
  const std::uint64_t exponent = (bits >> stored) & low_bits(exponent_bits);
  if (exponent == low_bits(exponent_bits)) return fraction != 0 ? "nan" : sign + "inf";
  if (exponent == 0 && fraction == 0) return sign + "0";
  const std::uint64_t significand = exponent == 0 ? fraction : fraction | std::uint64_t{1} << stored;
  const int last = format.lowest_exponent + (exponent == 0 ? 0 : static_cast<int>(exponent) - 1);
  return sign + arrange(shortest(significand, last, fraction == 0 && exponent > 1));
}

void write_text(std::ostream& out, std::string_view text) { out << text; }

}  // namespace isostep::detail
