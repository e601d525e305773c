// Bodies of joint_work.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/joint_work.hpp"

namespace isostep::detail {

/// Returns a turn within -pi..pi, equal to one within -4 pi..4 pi.
template <class S> S wrapped(S angle) {
  const S pi = kHalfTurn<S>;
  const S whole = pi + pi;
  for (int i = 0; i < 2 && pi < angle; ++i) angle -= whole;
  for (int i = 0; i < 2 && angle < -pi; ++i) angle += whole;
  return angle;
}
/// Returns twice the vector of a rotation: for small ones axis times angle.
template <class S> Vec3<S> twice_vector(Quat<Unit<S>> q) {
  const bool other = q.w < Unit<S>(0);
  const auto part = [other](Unit<S> x) {
    const S half = convert<S>(other ? -x : x);
    return half + half;
  };
  return {part(q.x), part(q.y), part(q.z)};
}

template <class S>
void JointWork<S>::prepare(const ArticulatedTree<S>& tree, const PreparedLink<S>& l,
                           const ArticulationDrive<S>& drive_of_it) {
  const bool slides = l.type == ArticulationJoint::slider;
  stiffness = tree.coefficient(drive_of_it.stiffness, l.type, 2);
  damping = tree.coefficient(drive_of_it.damping, l.type, 1);
  most = tree.over_mass(drive_of_it.max_force, slides ? 1 : 2);
  speed = slides ? held_product(drive_of_it.speed, tree.scale) : drive_of_it.speed;
}

template <class S>
void JointWork<S>::begin(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, const ArticulationState<S>& state,
                         const ArticulationDrive<S>& drive_of_it) {
  answer = Vec3<S>::zero();
  cone = Vec3<Unit<S>>::zero();
  stop = Stop::none;
  drive = S(0) < most ? Drive::within : Drive::none;
  stop_force = S(0);
  const S* const v = state.speeds.data() + l.speed;
  if (is_scalar(l.type)) {
    const bool slides = l.type == ArticulationJoint::slider;
    const S unit = slides ? tree.scale : S(1);
    const S q = held_product(state.coordinates[l.coordinate], unit);
    position = {q, S(0), S(0)};
    velocity = {held_product(v[0], unit), S(0), S(0)};
    const S away = held_product(drive_of_it.target, unit) - q;
    miss = {slides || l.limited ? away : wrapped(away), S(0), S(0)};
    room_up = l.upper - q;
    room_down = q - l.lower;
  } else if (l.type == ArticulationJoint::ball) {
    velocity = {v[0], v[1], v[2]};
    measure_ball(l, state.rotations[l.rotation], drive_of_it);
  }
}

template <class S>
void JointWork<S>::measure_ball(const PreparedLink<S>& l, Quat<Unit<S>> rotation,
                                const ArticulationDrive<S>& drive_of_it) {
  position = twice_vector<S>(rotation);
  miss = -twice_vector<S>(normalise(rotation * conjugate(drive_of_it.pose)));
  if (!l.limited) return;
  const Vec3<Unit<S>> turned = rotate(rotation, l.axis);
  const auto out = heading_of(cross(l.axis, turned));
  cone = out.direction;
  room_up = l.upper - atan2_to<S>(out.length, dot(l.axis, turned));
}

/// Returns k way + d speed, for h^2 k and h d.
template <class S>
Vec3<S> JointWork<S>::spring(const ArticulatedTree<S>& tree, Vec3<S> way, S stiffness_of_it, Vec3<S> speed_of_it,
                             S damping_of_it) const {
  const Vec3<S> by_way = held_product(held_product(way, stiffness_of_it), tree.rate);
  return held_product(held_sum(by_way, held_product(speed_of_it, damping_of_it)), tree.rate);
}

template <class S> void JointWork<S>::linearise(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, S inertia) {
  const Step<S> h = tree.h;
  const S driven = drive == Drive::within ? S(1) : S(0);
  const S hd = l.damping + damping * driven, hhk = l.stiffness + stiffness * driven;
  const S r = hd * S(0.5) + hhk * S(0.25);
  // Beyond 256 the difference between s and 1 no longer shows.
  const S ratio = r < held_product(inertia, S(256)) && S(0) < inertia ? divide_to<S>(r, inertia) : S(256);
  blend = divide_to<S>(ratio * ratio, S(1) + ratio * ratio);
  pivot = l.armature + hd * (S(0.5) + S(0.5) * blend) + hhk * (S(0.25) + S(0.75) * blend);
  const Vec3<S> ahead = held_product(velocity * h, blend);  // s h v
  const bool turns = l.type == ArticulationJoint::hinge && !l.limited;
  const Vec3<S> slack = l.type == ArticulationJoint::ball ? -position : Vec3<S>{l.rest - position.x, S(0), S(0)};
  const Vec3<S> back = turns ? Vec3<S>{wrapped(slack.x), S(0), S(0)} : slack;
  force = spring(tree, back - ahead, l.stiffness, -velocity, l.damping);
  if (drive == Drive::within) force = held_sum(force, spring(tree, miss - ahead, stiffness, speed - velocity, damping));
  if (drive == Drive::most) force = held_sum(force, most_way * most);
}

template <class S> S JointWork<S>::most_speed(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, S room) const {
  if (!(room < S(0))) return held_product(room, tree.rate);
  const S back = l.type == ArticulationJoint::slider ? held_product(kReturnSpeed<S>, tree.scale) : kReturnSpeed<S>;
  return max(held_product(room * S(0.25), tree.rate), -back);
}

template <class S> void JointWork<S>::stop_at(const ArticulatedTree<S>& tree, Stop which, S wanted, S now) {
  stop = which;
  stop_speed = wanted;
  stop_answer = clamp(held_product(wanted - now, tree.rate), -kMostSlide<S>, kMostSlide<S>);
}

template <class S> S JointWork<S>::allowed(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, S v) const {
  if (!l.limited) return v;
  const S up = min(v, most_speed(tree, l, room_up));
  return is_scalar(l.type) ? max(up, -most_speed(tree, l, room_down)) : up;
}

template <class S>
bool JointWork<S>::choose_stop(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, bool may_release) {
  if (!l.limited) return false;
  const bool ball = !is_scalar(l.type);
  if (ball && cone == Vec3<Unit<S>>::zero()) return false;
  if (stop != Stop::none) {
    const bool pulls = stop == Stop::upper ? S(0) < stop_force : stop_force < S(0);
    if (pulls && may_release) stop = Stop::none;
    return pulls && may_release;
  }
  const S now = ball ? held_dot(cone, velocity) : velocity.x;
  const S then = now + (ball ? held_dot(cone, answer) : answer.x) * tree.h;
  const S up = most_speed(tree, l, room_up);
  if (up < then) stop_at(tree, Stop::upper, up, now);
  else if (const S down = ball ? then : -most_speed(tree, l, room_down); then < down)
    stop_at(tree, Stop::lower, down, now);
  return stop != Stop::none;
}

template <class S> bool JointWork<S>::choose_drive(const ArticulatedTree<S>& tree, bool may_release) {
  if (drive == Drive::none) return false;
  const Vec3<S> change = answer * tree.h;
  const Vec3<S> ahead =
      held_sum(held_product(velocity * tree.h, blend), held_product(change * tree.h, S(0.25) + S(0.75) * blend));
  const Vec3<S> then = held_sum(velocity, held_product(change, S(0.5) + S(0.5) * blend));
  const Vec3<S> asked = spring(tree, miss - ahead, stiffness, speed - then, damping);
  if (drive == Drive::most) {
    if (!may_release || !(held_dot(most_way, asked) < most)) return false;
    drive = Drive::within;
    return true;
  }
  const auto heading = heading_of(asked);
  if (!(most < heading.length)) return false;
  drive = Drive::most;
  most_way = heading.direction;
  return true;
}

template <class S>
bool JointWork<S>::choose(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, bool may_release) {
  const bool stopped = choose_stop(tree, l, may_release);
  return choose_drive(tree, may_release) || stopped;
}

}  // namespace isostep::detail
