// Bodies of vehicle_rows.hpp: wheels that roll as one, and how the engine is geared to them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/vehicle_rows.hpp"

namespace isostep {

/// The first wheel of each track leads: its spin is that of the track, with the inertia of all as its axle feels it.
template <class S> void VehicleRows<S>::join_tracks(const Group& group) {
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const std::uint32_t track = wheel(runs_[i]).track;
    for (std::uint32_t j = group.first; j < i && track != 0; ++j) {
      if (wheel(runs_[j]).track != track) continue;
      runs_[i].leader = j;
      join(runs_[j], runs_[i]);
      while (runs_[j].next != kNone) j = runs_[j].next;
      runs_[j].next = i;
      break;
    }
  }
}
/// What the two turn with together, about their axles and for their radii, they keep.
template <class S> void VehicleRows<S>::join(Run& leader, Run& run) const {
  const S radius = wheel(leader).radius;
  run.to_leader = divide_to<S>(radius, wheel(run).radius);
  const S more = times(times(run.inertia, run.to_leader), run.to_leader);
  leader.inertia = saturating_add(leader.inertia, more);
  const V faster = saturating_subtract(run.spin.rim, leader.spin.rim);
  const U part = divide_to<U>(more, leader.inertia);
  leader.spin.rim = saturating_add(leader.spin.rim, saturate_to<V>(product(part, faster)));
  leader.spin.give = detail::rim_give(state_.awake.properties[leader.row - 1].mass, radius, leader.inertia);
}

/// As the wheel's own tyre finds it: with what the other tyres of its track do.
template <class S> detail::WheelSpin<S> VehicleRows<S>::spin_of(const Run& run) const {
  detail::WheelSpin<S> spin = runs_[run.leader].spin;
  for (std::uint32_t i = run.leader; i != kNone; i = runs_[i].next) {
    const Run& other = runs_[i];
    if (&other == &run || !other.touches) continue;
    spin.rim = saturating_subtract(spin.rim, saturate_to<V>(product(spin.give, other.push_along)));
  }
  return spin;
}
/// [m/s] Of the rim after the sub-step.
template <class S> Velocity<S> VehicleRows<S>::end_of(const Run& run) const {
  return spin_of(run).after(run.touches ? run.push_along : V(0));
}

/// [1] By which steering multiplies the drive of a track.
template <class S> S VehicleRows<S>::side_of(const Run& run, const Group& group) const {
  const WheelSettings<S>& w = wheel(run);
  if (w.track == 0) return S(1);
  const S left = dot(w.hard_point - state_.awake.properties[run.row - 1].local_centre, w.axle_direction);
  const S steer = input(group).steer;
  const bool is_inner = steer < S(0) ? left < S(0) : S(0) < left;
  return is_inner ? S(1) - times(vehicle(group).track_steer, abs(steer)) : S(1);
}
/// How many turns of the engine's shaft each wheel's and track's is.
template <class S> void VehicleRows<S>::gear_up(Group& group) {
  if (group.vehicle == kNone) return;
  S shares = S(0);
  for (std::uint32_t i = group.first; i < group.end; ++i) shares = saturating_add(shares, wheel(runs_[i]).drive_share);
  const S most = Limits<S>::mass_ratio();
  const S ratio = clamp(times(vehicle(group).gears[input(group).gear], vehicle(group).final_drive), -most, most);
  group.geared = S(0) < shares && !(ratio == S(0));
  begin_engine(group);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    Run &run = runs_[i], &leader = runs_[run.leader];
    const S share = wheel(run).drive_share;
    if (leads(run)) run.side = side_of(run, group);
    leader.driven = leader.driven || S(0) < share;
    if (!group.geared) continue;
    const S part = times(times(divide_to<S>(share, shares), ratio), leader.side);
    leader.drive = leads(run) ? part : saturating_add(leader.drive, times(part, run.to_leader));
  }
}

}  // namespace isostep
