// A command for the tests alone: it sets the world's clock.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

struct Probe {
  std::uint64_t tick;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("tick", self.tick);
  }
};

}  // namespace isostep
