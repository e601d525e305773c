// SensorOverlaps<S>: which parts of bodies entered and left sensors.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   WorldState::overlaps of the last step; those that the narrow phase found in this one; changed sensors.
/// Output:  WorldState::overlaps; events of overlaps that began and ended, in order.
/// Keeps:   nothing from step to step but memory.
template <class S> class SensorOverlaps {
 public:
  ISO_INLINE SensorOverlaps(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// Leaves the last step's overlaps in `found`. Appends to `events`, which may already hold ends that commands caused.
  void update(std::vector<SensorOverlap>& found, Events<S>& events);

 private:
  void list_changed();
  void keep_unwatched(std::vector<SensorOverlap>& found);
  bool are_joined(std::uint32_t sensor, std::uint32_t sleeper) const;
  void find_sleepers(std::uint32_t sensor, std::vector<SensorOverlap>& found) const;
  void find_sleeper(std::uint32_t sensor, std::uint32_t other, std::vector<SensorOverlap>& found) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  std::vector<std::uint32_t> changed_, slot_scratch_;  // slots of sensors that lie still, ascending
  std::vector<SensorOverlap> sort_scratch_;
  std::vector<SensorEvent> end_scratch_;
};

#define ISO_SENSOR_OVERLAPS_OF(extern, S) extern template class SensorOverlaps<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SENSOR_OVERLAPS_OF)

}  // namespace isostep
