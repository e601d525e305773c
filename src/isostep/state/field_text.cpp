// Fields as lines of text, for two programs that compare theirs.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "isostep/state/fields.hpp"

namespace isostep {
namespace {

// The letter of a format says how bits are read, the numbers how many there are and, of scalars, how many of them
// follow the point (q) or make the mantissa (f): what ScalarTraits::kId says.
constexpr char kLetters[] = {'b', 'i', 'u'};

std::string format_text(FieldFormat format) {
  char text[32];
  if (format.kind != FieldKind::scalar) {
    std::snprintf(text, sizeof text, "%c%u", kLetters[static_cast<std::uint32_t>(format.kind)], 8u * format.size);
  } else {
    std::snprintf(text, sizeof text, "%c%u.%u", format.scalar_id >> 16 == 1 ? 'f' : 'q', 8u * format.size,
                  format.scalar_id & 0xffu);
  }
  return text;
}

/// Takes a number from the front; false when there is none.
bool take_number(std::string_view& text, std::uint32_t& number) {
  std::size_t digits = 0;
  number = 0;
  for (; digits < text.size() && digits < 3 && text[digits] >= '0' && text[digits] <= '9'; ++digits)
    number = 10 * number + static_cast<std::uint32_t>(text[digits] - '0');
  text.remove_prefix(digits);
  return digits != 0;
}

bool read_format(std::string_view text, FieldFormat& format) {
  if (text.empty()) return false;
  const char letter = text.front();
  text.remove_prefix(1);
  std::uint32_t bits = 0, part = 0;
  if (!take_number(text, bits) || (bits != 8 && bits != 16 && bits != 32 && bits != 64)) return false;
  for (std::uint32_t kind = 0; kind < sizeof kLetters; ++kind) {
    format = {static_cast<FieldKind>(kind), bits / 8, 0};
    if (letter == kLetters[kind]) return text.empty();
  }
  if ((letter != 'f' && letter != 'q') || text.empty() || text.front() != '.') return false;
  text.remove_prefix(1);
  if (!take_number(text, part) || part > bits || !text.empty()) return false;
  format = {FieldKind::scalar, bits / 8, (letter == 'f' ? 1u : 2u) << 16 | bits << 8 | part};
  return true;
}

bool read_bits(std::string_view text, std::uint32_t size, std::uint64_t& bits) {
  if (text.size() != 2 + 2 * size || text.substr(0, 2) != "0x") return false;
  bits = 0;
  for (const char c : text.substr(2)) {
    const bool decimal = c >= '0' && c <= '9';
    if (!decimal && (c < 'a' || c > 'f')) return false;
    bits = bits << 4 | static_cast<std::uint64_t>(decimal ? c - '0' : c - 'a' + 10);
  }
  return true;
}

}  // namespace

std::string field_line(const NamedField& field) {
  return field.path + "\t" + format_text(field.format) + "\t" + bits_text(field.format, field.bits);
}

bool read_field_line(std::string_view line, NamedField& field) {
  const std::size_t first = line.find('\t'), last = line.rfind('\t');
  if (first == last || first == 0) return false;
  field.path = line.substr(0, first);
  return read_format(line.substr(first + 1, last - first - 1), field.format) &&
         read_bits(line.substr(last + 1), field.format.size, field.bits);
}

}  // namespace isostep
