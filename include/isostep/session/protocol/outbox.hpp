// Outbox: which messages are due to a peer, each once.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// In: kinds of messages that become due. Out: each to the code that writes it, from the state of that moment. Keeps: a
/// bit per kind. `Kind`: an enumeration of at most 32 values, the most urgent first where the order counts.
template <class Kind> class Outbox {
 public:
  void add(Kind kind) { bits_ |= bit(kind); }
  void drop(Kind kind) { bits_ &= ~bit(kind); }
  void set(Kind kind, bool is_due) { is_due ? add(kind) : drop(kind); }
  bool has(Kind kind) const { return (bits_ & bit(kind)) != 0; }
  bool is_empty() const { return bits_ == 0; }
  bool take(Kind kind) {
    const bool is_due = has(kind);
    drop(kind);
    return is_due;
  }
  std::optional<Kind> first() const { return first_of(bits_); }
  std::optional<Kind> first_but(Kind kind) const { return first_of(bits_ & ~bit(kind)); }

 private:
  static std::uint32_t bit(Kind kind) { return std::uint32_t{1} << static_cast<int>(kind); }
  static std::optional<Kind> first_of(std::uint32_t bits) {
    return bits == 0 ? std::nullopt : std::optional(static_cast<Kind>(std::countr_zero(bits)));
  }

  std::uint32_t bits_ = 0;
};

}  // namespace isostep
