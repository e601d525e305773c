// ByteWriter: little-endian numbers one after another, as decode.js reads them.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace isostep::tool::page {

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& out) : out_(out) {}
  void u8(std::uint32_t x) { out_.push_back(static_cast<std::uint8_t>(x)); }
  void u16(std::uint32_t x) { u8(x & 0xff), u8(x >> 8); }
  void u32(std::uint32_t x) { u16(x & 0xffff), u16(x >> 16); }
  void u64(std::uint64_t x) { u32(static_cast<std::uint32_t>(x)), u32(static_cast<std::uint32_t>(x >> 32)); }
  void f32(double x) { u32(std::bit_cast<std::uint32_t>(static_cast<float>(x))); }
  void count(std::size_t n) { u32(static_cast<std::uint32_t>(n)); }

 private:
  std::vector<std::uint8_t>& out_;
};

}  // namespace isostep::tool::page
