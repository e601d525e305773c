// A command for the tests alone: it sets the world's clock.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

struct Probe {
  std::uint64_t tick;
  ISO_FIELDS(tick)
};

}  // namespace isostep
