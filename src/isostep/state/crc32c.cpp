// CRC-32C by eight tables, eight bytes at a time.
// SPDX-License-Identifier: MIT
#include "isostep/core/crc32c.hpp"

#include <cstddef>

namespace isostep {
namespace {

constexpr std::uint32_t kReflectedPolynomial = 0x82f63b78u;

/// rows[k][b]: the remainder of byte b followed by k zero bytes.
struct Tables {
  std::uint32_t rows[8][256];
};

consteval Tables make_tables() {
  Tables tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t crc = b;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? kReflectedPolynomial : 0u);
    tables.rows[0][b] = crc;
  }
  for (int k = 1; k < 8; ++k) {
    for (std::uint32_t b = 0; b < 256; ++b) {
      const std::uint32_t shorter = tables.rows[k - 1][b];
      tables.rows[k][b] = (shorter >> 8) ^ tables.rows[0][shorter & 0xffu];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

}  // namespace

std::uint32_t crc32c(Bytes bytes, std::uint32_t before) {
  const auto& rows = kTables.rows;
  const std::uint8_t* at = bytes.data();
  std::size_t left = bytes.size();
  std::uint32_t crc = ~before;
  for (; left >= 8; left -= 8, at += 8) {
    const std::uint32_t low = crc ^ load_le<std::uint32_t>(at);
    crc = rows[7][low & 0xffu] ^ rows[6][(low >> 8) & 0xffu] ^ rows[5][(low >> 16) & 0xffu] ^ rows[4][low >> 24] ^
          rows[3][at[4]] ^ rows[2][at[5]] ^ rows[1][at[6]] ^ rows[0][at[7]];
  }
  for (; left > 0; --left, ++at) crc = (crc >> 8) ^ rows[0][(crc ^ *at) & 0xffu];
  return ~crc;
}

}  // namespace isostep
