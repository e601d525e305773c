// Bodies of sensor_overlaps.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/world/event_order.hpp"
#include "isostep/world/sensor_overlaps.hpp"

namespace isostep {

namespace detail {
struct ByOverlap {
  ISO_INLINE std::uint64_t operator()(SensorOverlap o) const { return std::uint64_t{o.sensor} << 32 | o.other; }
};
}  // namespace detail

/// Overlaps of bodies neither of which is awake stay: the narrow phase does not look at them, because nothing moved.
template <class S> void SensorOverlaps<S>::keep_unwatched(std::vector<SensorOverlap>& found) {
  for (const SensorOverlap& old : state_.overlaps) {
    const bool watched =
        map_.location(old.sensor).set == Location::kAwake || map_.location(old.other).set == Location::kAwake;
    if (!watched) found.push_back(old);
  }
  sort_scratch_.resize(found.size());
  stable_sort(found.data(), sort_scratch_.data(), static_cast<std::uint32_t>(found.size()), detail::ByOverlap{});
}

template <class S> void SensorOverlaps<S>::update(std::vector<SensorOverlap>& found, Events<S>& events) {
  keep_unwatched(found);
  const std::vector<SensorOverlap>& old = state_.overlaps;
  const auto event = [&](SensorOverlap o) {
    return SensorEvent{state_.body_slots.template id_of<BodyId>(o.sensor),
                       state_.body_slots.template id_of<BodyId>(o.other)};
  };
  const bool told = !events.sensor_end.empty();
  std::size_t i = 0, j = 0;
  while (i < old.size() || j < found.size()) {
    const bool old_first = j == found.size() || (i < old.size() && old[i] < found[j]);
    const bool new_first = i == old.size() || (j < found.size() && found[j] < old[i]);
    if (old_first) events.sensor_end.push_back(event(old[i++]));
    else if (new_first) events.sensor_begin.push_back(event(found[j++]));
    else ++i, ++j;
  }
  state_.overlaps.swap(found);
  if (told) detail::sort_ends(events.sensor_end, end_scratch_);
}

}  // namespace isostep
