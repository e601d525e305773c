// Graph colouring: constraints of one colour share no body that moves, so they may be solved side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Colours greedily, in canonical order. A constraint gets the first colour that is free at both bodies. Without one it
/// is kUncoloured and solved alone. The result depends only on the constraints' order and bodies.
class Colouring {
 public:
  static constexpr std::uint32_t kColours = 32;
  static constexpr std::uint32_t kUncoloured = kColours;

  void begin(std::size_t body_rows) { used_.assign(body_rows, 0); }

  /// Returns a colour for a constraint between two rows of SolverBodies. A row that does not move sets no limit.
  std::uint32_t colour(std::uint32_t row_a, bool moves_a, std::uint32_t row_b, bool moves_b) {
    const std::uint32_t taken = (moves_a ? used_[row_a] : 0u) | (moves_b ? used_[row_b] : 0u);
    const auto free = static_cast<std::uint32_t>(std::countr_one(taken));
    if (free >= kColours) return kUncoloured;
    if (moves_a) used_[row_a] |= 1u << free;
    if (moves_b) used_[row_b] |= 1u << free;
    return free;
  }

 private:
  std::vector<std::uint32_t> used_;  // a bit a colour
};

}  // namespace isostep
