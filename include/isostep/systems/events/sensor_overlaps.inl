// Bodies of sensor_overlaps.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/store/event_order.hpp"
#include "isostep/systems/events/sensor_overlaps.hpp"

namespace isostep {

namespace detail {
struct ByOverlap {
  ISO_INLINE std::uint64_t operator()(SensorOverlap o) const { return std::uint64_t{o.sensor} << 32 | o.other; }
};
}  // namespace detail

/// Sensors that commands placed or changed, and that are still there.
template <class S> void SensorOverlaps<S>::list_changed() {
  changed_.clear();
  for (const BodyId sensor : state_.untold.sensors) {
    if (!state_.body_slots.holds(sensor) || map_.location(sensor.slot).set != Location::kStatic) continue;
    changed_.push_back(sensor.slot);
  }
  state_.untold.sensors.clear();
  slot_scratch_.resize(changed_.size());
  stable_sort(changed_.data(), slot_scratch_.data(), static_cast<std::uint32_t>(changed_.size()), OwnKey{});
}

/// Overlaps of bodies neither of which is awake stay: the narrow phase does not look at them, because nothing moved but
/// by a command.
template <class S> void SensorOverlaps<S>::keep_unwatched(std::vector<SensorOverlap>& found) {
  list_changed();
  const auto is_changed = [&](std::uint32_t sensor) {
    const std::size_t at = lower_bound(changed_.size(), [&](std::size_t i) { return changed_[i] < sensor; });
    return at < changed_.size() && changed_[at] == sensor;
  };
  for (const SensorOverlap& old : state_.overlaps) {
    const bool watched =
        map_.location(old.sensor).set == Location::kAwake || map_.location(old.other).set == Location::kAwake;
    if (!watched && !is_changed(old.sensor)) found.push_back(old);
  }
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    if (i == 0 || changed_[i] != changed_[i - 1]) find_sleepers(changed_[i], found);
  }
  sort_scratch_.resize(found.size());
  stable_sort(found.data(), sort_scratch_.data(), static_cast<std::uint32_t>(found.size()), detail::ByOverlap{});
}

template <class S>
void SensorOverlaps<S>::find_sleepers(std::uint32_t sensor, std::vector<SensorOverlap>& found) const {
  if (!proxies_.present(sensor)) return;
  const auto traits_of = [&](std::uint32_t slot, bool awake) {
    return ProxyTraits::of(map_.properties_at(map_.location(slot)), awake);
  };
  const ProxyTraits traits = traits_of(sensor, true);
  proxies_.boxes().query(proxies_.boxes().box(sensor), [&](std::uint32_t other) {
    const bool sees = map_.location(other).is_asleep() && traits.pairs_with(traits_of(other, false));
    if (sees && bodies_touch(map_, min(sensor, other), max(sensor, other), S(0))) found.push_back({sensor, other});
    return true;
  });
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
