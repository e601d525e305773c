// SensorOverlaps<S>: which bodies entered and left sensors.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/world/body_map.hpp"
#include "isostep/world/events.hpp"

namespace isostep {

/// Input:   WorldState::overlaps of the last step; those that the narrow phase found in this one.
/// Output:  WorldState::overlaps; events of their begin and end, in order.
/// Keeps:   nothing from step to step but memory.
template <class S> class SensorOverlaps {
 public:
  ISO_INLINE SensorOverlaps(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Leaves the last step's overlaps in `found`. Appends to `events`, which may hold ends that commands made.
  void update(std::vector<SensorOverlap>& found, Events<S>& events);

 private:
  void keep_unwatched(std::vector<SensorOverlap>& found);

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<SensorOverlap> sort_scratch_;
  std::vector<SensorEvent> end_scratch_;
};

#define ISO_EXTERN(S) extern template class SensorOverlaps<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
