// The narrow phase in fixed point that traps on overflow.
// SPDX-License-Identifier: MIT
#include "unit/collision/narrowphase/trapping.hpp"

#include "isostep/collision/narrowphase/collide.inl"
#include "isostep/geometry/baked/hull_content.inl"

namespace isostep {

ISO_TRAPPING_NARROW_PHASE(, TrapQ16)
ISO_TRAPPING_NARROW_PHASE(, TrapQ32)

}  // namespace isostep
