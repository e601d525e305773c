// Bodies of sensor_overlaps.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/body_frames.inl"
#include "isostep/store/event_order.hpp"
#include "isostep/store/ghosts.hpp"
#include "isostep/systems/events/sensor_overlaps.hpp"

namespace isostep {

namespace detail {
struct ByBothBodies {
  ISO_INLINE std::uint64_t operator()(SensorOverlap o) const { return o.bodies(); }
};
struct ByPartsOfBoth {
  ISO_INLINE std::uint64_t operator()(SensorOverlap o) const { return o.parts(); }
};
}  // namespace detail

/// Lists the existing static sensors that commands placed or changed.
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

/// Keeps overlaps of two bodies that are not awake. The narrow phase does not see them, since only a command can move
/// them.
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
  const auto count = static_cast<std::uint32_t>(found.size());
  stable_sort(found.data(), sort_scratch_.data(), count, detail::ByPartsOfBoth{});
  stable_sort(found.data(), sort_scratch_.data(), count, detail::ByBothBodies{});
  std::size_t kept = 0;  // parts with many triangles are found once for each
  for (const SensorOverlap overlap : found) {
    if (kept == 0 || !(found[kept - 1] == overlap)) found[kept++] = overlap;
  }
  found.resize(kept);
}

template <class S>
void SensorOverlaps<S>::find_sleepers(std::uint32_t sensor, std::vector<SensorOverlap>& found) const {
  if (!proxies_.present(sensor)) return;
  const auto traits_of = [&](std::uint32_t slot, bool awake) {
    const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
    return ProxyTraits::of(body, map_.shapes.traits_of(body.shape), awake);
  };
  const ProxyTraits traits = traits_of(sensor, true);
  proxies_.boxes().query(proxies_.boxes().box(sensor), [&](std::uint32_t other) {
    const bool sees = map_.location(other).is_asleep() && traits.pairs_with(traits_of(other, false));
    if (sees && !are_ghosts(state_, map_, sensor, other) && !are_joined(sensor, other))
      find_sleeper(sensor, other, found);
    return true;
  });
}
/// Returns true if a joint of the sleeper ties it to the sensor and keeps the two from colliding.
template <class S> bool SensorOverlaps<S>::are_joined(std::uint32_t sensor, std::uint32_t sleeper) const {
  const SleepingIsland<S>& island = *state_.sleeping[map_.location(sleeper).set];
  for (const JointProperties<S>& joint : island.joints.properties) {
    const bool ties =
        (joint.body_a == sensor && joint.body_b == sleeper) || (joint.body_a == sleeper && joint.body_b == sensor);
    if (ties && (joint.flags & joint_flag::kCollideConnected) == 0) return true;
  }
  return false;
}
/// Finds all parts of a sleeper that parts of the sensor detect.
template <class S>
void SensorOverlaps<S>::find_sleeper(std::uint32_t sensor, std::uint32_t other,
                                     std::vector<SensorOverlap>& found) const {
  const BodyFrame<S> a = frame_at(map_, map_.location(min(sensor, other)));
  const BodyFrame<S> b = frame_at(map_, map_.location(max(sensor, other)));
  visit_meetings(map_, a, b, S(0), [&](std::uint32_t i, std::uint32_t j, PartMeeting meeting) {
    if (meeting != PartMeeting::sensed) return true;
    const SensorOverlap overlap = detail::overlap_of(a, i, b, j);
    if (overlap.sensor != sensor) return true;  // it is seen
    Manifold<S> manifold;
    collide_parts(collide_polyhedra<S>, a, i, b, j, S(0), manifold);
    if (manifold.count > 0) found.push_back(overlap);
    return true;
  });
}

template <class S> void SensorOverlaps<S>::update(std::vector<SensorOverlap>& found, Events<S>& events) {
  keep_unwatched(found);
  const std::vector<SensorOverlap>& old = state_.overlaps;
  const auto event = [&](SensorOverlap o) {
    return SensorEvent{state_.body_slots.template id_of<BodyId>(o.sensor),
                       state_.body_slots.template id_of<BodyId>(o.other), o.sensor_child, o.other_child};
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
