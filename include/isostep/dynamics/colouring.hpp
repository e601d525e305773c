// Graph colouring: constraints of one colour share no body that moves, so they may be solved side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Colours greedily, in canonical order: a constraint gets the first colour that neither body has met. One that finds
/// none is kUncoloured and is solved alone. The result depends on the constraints' order and bodies, nothing else.
class Colouring {
 public:
  static constexpr std::uint32_t kColours = 32;
  static constexpr std::uint32_t kUncoloured = kColours;

  void begin(std::size_t body_rows) { used_.assign(body_rows, 0); }

  /// A colour for a constraint between two rows of SolverBodies; a row that does not move limits nothing.
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
