// Resimulation: what remembering steps has spared a world.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep {

/// Counts the steps of ticks that were remembered, since the world was told to remember.
struct Resimulation {
  std::uint64_t parts = 0;    // steps that took what did not differ from memory
  std::uint64_t whole = 0;    // steps that could not
  std::uint64_t bodies = 0;   // awake bodies of `parts`, summed over the steps
  std::uint64_t stepped = 0;  // those of them that had to be stepped
};

}  // namespace isostep
