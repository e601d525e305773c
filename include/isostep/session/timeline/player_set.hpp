// EachPlayer: goes through a set of players, which is a bit for each, in order.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Iterates over a set of players: for (const int player : EachPlayer(players)) ...
struct EachPlayer {
  std::uint32_t left;

  explicit EachPlayer(std::uint32_t players) : left(players) {}
  EachPlayer begin() const { return *this; }
  EachPlayer end() const { return EachPlayer(0); }
  int operator*() const { return std::countr_zero(left); }
  void operator++() { left &= left - 1; }
  friend bool operator==(const EachPlayer&, const EachPlayer&) = default;
};

/// Returns the first player of the set; -1: it is empty.
inline int first_of(std::uint32_t players) { return players == 0 ? -1 : std::countr_zero(players); }

}  // namespace isostep
