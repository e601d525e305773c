// The narrow phase in fixed point that traps on overflow. It takes long to compile, so trapping.cpp alone does.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/geometry/baked/hull_content.hpp"

namespace isostep {

using TrapQ16 = Fixed<std::int32_t, 16, Overflow::trap>;
using TrapQ32 = Fixed<std::int64_t, 32, Overflow::trap>;

#define ISO_TRAPPING_NARROW_PHASE(extern, S) \
  ISO_COLLIDE_OF(extern, S)                  \
  extern template struct HullContent<S>;
ISO_TRAPPING_NARROW_PHASE(extern, TrapQ16)
ISO_TRAPPING_NARROW_PHASE(extern, TrapQ32)

}  // namespace isostep
