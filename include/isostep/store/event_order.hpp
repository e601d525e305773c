// The order of events that tell of an end: ascending by slots, and of one pair of bodies by parts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/events.hpp"

namespace isostep::detail {

/// Sorts ends by slots. No two ends of contacts have the same slots, and no two of overlaps have the same slots and
/// parts: a body that took another's slot has not been through a step.
struct EndKey {
  ISO_INLINE std::uint64_t operator()(const ContactEnd& end) const { return pair_key(end.a.slot, end.b.slot); }
  ISO_INLINE std::uint64_t operator()(const SensorEvent& end) const {
    return std::uint64_t{end.sensor.slot} << 32 | end.other.slot;
  }
};
struct EndPartsKey {
  ISO_INLINE std::uint64_t operator()(const SensorEvent& end) const {
    return std::uint64_t{end.sensor_child} << 32 | end.other_child;
  }
};
template <class End> ISO_INLINE void sort_ends(std::vector<End>& ends, std::vector<End>& scratch) {
  scratch.resize(ends.size());
  if constexpr (std::is_same_v<End, SensorEvent>)
    stable_sort(ends.data(), scratch.data(), static_cast<std::uint32_t>(ends.size()), EndPartsKey{});
  stable_sort(ends.data(), scratch.data(), static_cast<std::uint32_t>(ends.size()), EndKey{});
}

}  // namespace isostep::detail
