// The order of events that tell of an end: ascending by slots.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/events.hpp"

namespace isostep::detail {

/// No two ends have the same slots: a body that took another's slot has not been through a step.
struct EndKey {
  ISO_INLINE std::uint64_t operator()(const ContactEnd& end) const { return pair_key(end.a.slot, end.b.slot); }
  ISO_INLINE std::uint64_t operator()(const SensorEvent& end) const {
    return std::uint64_t{end.sensor.slot} << 32 | end.other.slot;
  }
};
template <class End> ISO_INLINE void sort_ends(std::vector<End>& ends, std::vector<End>& scratch) {
  scratch.resize(ends.size());
  stable_sort(ends.data(), scratch.data(), static_cast<std::uint32_t>(ends.size()), EndKey{});
}

}  // namespace isostep::detail
