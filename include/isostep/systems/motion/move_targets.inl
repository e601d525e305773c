// Bodies of move_targets.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/systems/motion/move_targets.hpp"

namespace isostep {

template <class S> void MoveTargets<S>::begin_step() {
  moves_.clear();
  for (const PendingMove<S>& move : state_.moves) {
    const Location at = map_.location(move.slot);
    if (at.set != Location::kAwake) continue;  // disabled
    BodyProperties<S>& body = state_.awake.properties[at.index];
    const Pose<S> goal = detail::centre_at(move.pose, body.local_centre);
    const bool reaches = start(state_.awake.states[at.index], goal);
    moves_.push_back({move.slot, goal, reaches, body.flags & body_flag::kAllLocks});
    body.flags &= ~body_flag::kAllLocks;
  }
}

/// Sets the velocity towards the goal. Returns true if it leads all the way.
template <class S> bool MoveTargets<S>::start(BodyState<S>& state, const Pose<S>& goal) const {
  using V = Velocity<S>;
  const Settings<S>& s = state_.settings;
  const S hz = S(s.hz);
  // Rates are held within twice the limits first, so that lengths fit.
  const auto rate = [&](Vec3<S> way, S limit) {
    const S most = limit + limit;
    const auto part = [&](S x) { return convert<V>(detail::saturate_at<S>(product(x, hz), most)); };
    return Vec3<V>{part(way.x), part(way.y), part(way.z)};
  };
  const S speed = Limits<S>::speed(), turning = detail::most_angular_speed(state.fat);
  const Vec3<V> linear = rate(saturating_subtract(goal.position, state.centre), speed);
  const Vec3<V> angular = rate(rotation_vector_of<S>(goal.orientation * conjugate(state.orientation)), turning);
  const V fastest = min(convert<V>(turning), angular_speed_limit<S>(integration_rate(s.solver, s.hz, s.substeps)));
  state.velocity = detail::shortened(linear, convert<V>(speed));
  state.angular_velocity = detail::shortened(angular, fastest);
  return state.velocity == linear && state.angular_velocity == angular;
}

/// Puts bodies exactly on their goals: sub-steps lead there except for rounding.
template <class S> void MoveTargets<S>::arrive() {
  for (const Move& move : moves_) {
    if (!move.reaches) continue;
    BodyState<S>& state = state_of(move);
    state.centre = move.goal.position;
    state.orientation = move.goal.orientation;
  }
}

template <class S> void MoveTargets<S>::end_step() {
  for (const Move& move : moves_) {
    state_.awake.properties[map_.location(move.body).index].flags |= move.locks;
    state_of(move).velocity = Vec3<Velocity<S>>::zero();
    state_of(move).angular_velocity = Vec3<Velocity<S>>::zero();
  }
  std::size_t next = 0;  // of moves_, which ascend too; those of disabled bodies wait
  std::erase_if(state_.moves, [&](const PendingMove<S>& move) {
    const bool done = next < moves_.size() && moves_[next].body == move.slot;
    if (done) ++next;
    return done;
  });
}

}  // namespace isostep
