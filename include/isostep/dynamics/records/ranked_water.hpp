// RankedWater: a body of water that stands in place of others where they overlap.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/water.hpp"

namespace isostep {

using RankedWaterId = Id<struct RankedWaterTag>;

/// A Water with a rank: a lock or a tank in the sea, with a level, a density and a current of its own. A body, of a
/// category of the mask, whose centre of mass is in its region has this water and none of lower priority, below the
/// surface and above it. A Water has rank 0: higher ranks hide it, and it hides none. Waters of one rank add up. Unlike
/// a Water it acts on no body whose centre is outside, so that of two regions side by side a body has one at a time. A
/// RankedZone that replaces the water hides those of lower priority.
template <class S> struct RankedWater : Water<S> {
  std::int32_t priority = 0;

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    Water<S>::fields(visit, self);
    visit("priority", self.priority);
  }
};

}  // namespace isostep
