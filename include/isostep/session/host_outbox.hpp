// Outbox: which messages are due to a guest, and in which order it hears them.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// The most urgent first. What they say is written when they are sent: as it is then.
enum class Due : std::uint8_t {
  close,       // its connection ends
  welcome,     // it is in the match, or gets a snapshot
  roster,      // another
  ballot,      // how the vote stands
  inquiry,     // which chain has it?
  statements,  // who said what
  repaired,    // who is: see RepairService::tells
  offer,       // of a repair, or none
  open         // from when on its players play
};

/// Each kind at most once.
class Outbox {
 public:
  void set(Due due, bool is_due = true) {
    const std::uint32_t bit = 1u << static_cast<int>(due);
    bits_ = is_due ? bits_ | bit : bits_ & ~bit;
  }
  bool has(Due due) const { return (bits_ >> static_cast<int>(due) & 1) != 0; }
  std::optional<Due> first() const { return first_of(bits_); }
  std::optional<Due> first_but(Due due) const { return first_of(bits_ & ~(1u << static_cast<int>(due))); }

 private:
  static std::optional<Due> first_of(std::uint32_t bits) {
    return bits == 0 ? std::nullopt : std::optional(static_cast<Due>(std::countr_zero(bits)));
  }

  std::uint32_t bits_ = 0;
};

}  // namespace isostep
