// Bodies of stopped_bodies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/continuous/stopped_bodies.hpp"

namespace isostep {

namespace detail {
/// Returns the angular velocity of a body whose orientation is put back: unchanged in its own axes. Kept in world axes,
/// it would meet another inertia, and a rod at 300 rad/s would gain six times its energy.
template <class S> Vec3<Velocity<S>> turned_back(const BodyState<S>& state, Quat<Unit<S>> orientation) {
  const Mat3<Unit<S>> back = to_matrix(normalise(orientation * conjugate(state.orientation)));
  return back * state.angular_velocity;
}
/// Puts the centre inside the world: rounding and joints can lead beyond its edge.
template <class S> ISO_INLINE void put_centre(BodyState<S>& state, Vec3<S> place) {
  state.centre = held_within(place, Limits<S>::position());
}
/// Returns the velocity without what gravity [m/s^2] added on the part `left_out` [m] of the way: with it a body would
/// bounce higher than it fell. s' = sqrt(s^2 - 2 work), by the mean speed, so that no square has to fit.
template <class S> Vec3<Velocity<S>> without_fall(Vec3<Velocity<S>> velocity, Vec3<S> gravity, Vec3<S> left_out) {
  using V = Velocity<S>;
  const Heading<S> down = heading_of(gravity);
  const V falls = round_to<V>(dot_sum(down.direction, velocity)), speed = abs(falls);
  const S work = saturate_to<S>(product(down.length, dot(down.direction, left_out)));  // [m^2/s^2]
  if (!(V(0) < speed) || work == S(0) || (work < S(0)) != (falls < V(0))) return velocity;
  V left = speed;
  for (int i = 0; i < 4; ++i) {
    const V mean = round_to<V>(product(S(0.5), speed) + product(S(0.5), left));
    if (!(work < saturate_to<S>(product(speed, mean)))) return velocity - down.direction * falls;
    left = max(speed - divide_to<V>(work, mean), V(0));
  }
  return velocity + down.direction * (falls < V(0) ? speed - left : left - speed);
}
}  // namespace detail

template <class S> void StoppedBodies<S>::stop(std::uint32_t index, const MotionCut<S>& cut, bool moving) {
  BodyState<S>& state = state_.awake.states[index];
  const Vec3<S> end = state.centre;
  put_at(index, cut.pose);
  const S scale = state_.awake.properties[index].gravity_scale;
  state.velocity = detail::without_fall(state.velocity, state_.settings.gravity * scale, end - state.centre);
  if (cut.stops_middle()) stop_middle(state, cut, moving);
  place(index);
}
template <class S> void StoppedBodies<S>::put_at(std::uint32_t index, const Pose<S>& pose) {
  BodyState<S>& state = state_.awake.states[index];
  if (detail::turns_freely(state_.awake.properties[index]))
    state.angular_velocity = detail::turned_back(state, pose.orientation);
  detail::put_centre(state, pose.position);
  state.orientation = pose.orientation;
}
template <class S> void StoppedBodies<S>::place(std::uint32_t index) {
  BodyState<S>& state = state_.awake.states[index];
  const BodyProperties<S>& body = state_.awake.properties[index];
  detail::renew_fat_box(map_, state, body, false);
  proxies_.place(state, body, true);
}

/// Stops the middle of a part. A body whose middle is beyond a surface is not pushed out, so it loses its speed into
/// it; it may still turn. A body that a moving one stops keeps its speed: contacts share it between the two.
template <class S> void StoppedBodies<S>::stop_middle(BodyState<S>& state, const MotionCut<S>& cut, bool moving) const {
  using V = Velocity<S>;
  detail::put_centre(state, cut.place - rotate(state.orientation, cut.middle));
  if (moving) return;
  const V inwards = max(V(0), saturate_to<V>(dot_sum(cut.normal, state.velocity)));
  state.velocity -= Vec3<V>{round_to<V>(product(cut.normal.x, inwards)), round_to<V>(product(cut.normal.y, inwards)),
                            round_to<V>(product(cut.normal.z, inwards))};
}

}  // namespace isostep
