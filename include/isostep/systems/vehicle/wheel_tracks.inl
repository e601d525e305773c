// Bodies of wheel_tracks.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/wheel_tracks.hpp"

namespace isostep {

template <class S> void WheelTracks<S>::join(const Group& group) {
  const std::span<Run> runs = wheels_.runs();
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const std::uint32_t track = wheels_.wheel(runs[i]).track;
    for (std::uint32_t j = group.first; j < i && track != 0; ++j) {
      if (wheels_.wheel(runs[j]).track != track) continue;
      runs[i].leader = j;
      join(runs[j], runs[i]);
      while (runs[j].next != Run::kNone) j = runs[j].next;
      runs[j].next = i;
      break;
    }
  }
}
/// Joins a wheel to its leader. Both keep their common angular momentum, about their axles and scaled to their radii.
template <class S> void WheelTracks<S>::join(Run& leader, Run& run) {
  const S radius = wheels_.wheel(leader).radius;
  run.to_leader = divide_to<S>(radius, wheels_.wheel(run).radius);
  const S more = detail::times(detail::times(run.inertia, run.to_leader), run.to_leader);
  leader.inertia = saturating_add(leader.inertia, more);
  const V faster = saturating_subtract(run.spin.rim, leader.spin.rim);
  const U part = divide_to<U>(more, leader.inertia);
  leader.spin.rim = saturating_add(leader.spin.rim, saturate_to<V>(product(part, faster)));
  leader.spin.give = detail::rim_give(state_.awake.properties[leader.row - 1].mass, radius, leader.inertia);
}

template <class S> detail::WheelSpin<S> WheelTracks<S>::spin_of(const Run& run) const {
  const std::span<const Run> runs = wheels_.runs();
  detail::WheelSpin<S> spin = runs[run.leader].spin;
  for (std::uint32_t i = run.leader; i != Run::kNone; i = runs[i].next) {
    const Run& other = runs[i];
    if (&other == &run || !other.touches) continue;
    spin.rim = saturating_subtract(spin.rim, saturate_to<V>(product(spin.give, other.push_along)));
  }
  return spin;
}
template <class S> Velocity<S> WheelTracks<S>::end_of(const Run& run) const {
  return spin_of(run).after(run.touches ? run.push_along : V(0));
}

}  // namespace isostep
