// Small numbers in few bytes: LEB128 and zigzag, written into fixed buffers and read from bytes nobody vouches for.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/bytes.hpp"

namespace isostep {

/// Writes until the buffer is full. Then full() is true, and nothing more is written.
class WireWriter {
 public:
  WireWriter(std::uint8_t* buffer, std::size_t capacity) : buffer_(buffer), capacity_(capacity) {}

  void byte(std::uint8_t value) {
    if (size_ < capacity_) {
      buffer_[size_++] = value;
    } else {
      full_ = true;
    }
  }
  template <std::unsigned_integral U> void fixed(U value) {
    for (std::size_t i = 0; i < sizeof(U); ++i) byte(static_cast<std::uint8_t>(std::uint64_t{value} >> (8 * i)));
  }
  void number(std::uint32_t value) {
    std::uint8_t bytes[kLongestLeb128];
    raw({bytes, store_leb128(bytes, value)});
  }
  void difference(std::int32_t value) {
    number(static_cast<std::uint32_t>(value) << 1 ^ (value < 0 ? 0xffffffffu : 0u));
  }
  void raw(Bytes bytes) {
    for (const std::uint8_t b : bytes) byte(b);
  }
  std::size_t size() const { return size_; }
  bool full() const { return full_; }

 private:
  std::uint8_t* buffer_;
  std::size_t capacity_;
  std::size_t size_ = 0;
  bool full_ = false;
};

/// Reads untrusted bytes. After the first failure every read returns zero.
class WireReader {
 public:
  explicit WireReader(Bytes bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (at_ < bytes_.size()) return bytes_[at_++];
    failed_ = true;
    return 0;
  }
  template <std::unsigned_integral U> U fixed() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(U); ++i) value |= std::uint64_t{byte()} << (8 * i);
    return static_cast<U>(value);
  }
  /// Reads a number of at most 32 bits. It must have the fewest bytes possible, so that each number has one form.
  std::uint32_t number() {
    const Leb128 read = load_leb128(bytes_.subspan(at_), 0xffffffffu);
    failed_ = failed_ || read.flaw != Leb128Flaw::none;
    if (failed_) return 0;
    at_ += read.size;
    return static_cast<std::uint32_t>(read.value);
  }
  std::int32_t difference() {
    const std::uint32_t value = number();
    return static_cast<std::int32_t>(value >> 1 ^ (0u - (value & 1u)));
  }
  Bytes raw(std::size_t size) {
    if (size > remaining()) {
      failed_ = true;
      return {};
    }
    at_ += size;
    return bytes_.subspan(at_ - size, size);
  }
  std::size_t remaining() const { return failed_ ? 0 : bytes_.size() - at_; }
  bool failed() const { return failed_; }
  void fail() { failed_ = true; }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace isostep
