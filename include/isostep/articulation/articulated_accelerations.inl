// ArticulatedDynamics: forces inwards, accelerations outwards (table 7.1, the rest of the second pass and the third).
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulated_dynamics.hpp"

namespace isostep::detail {

/// Returns a less b . c and d . e, held.
template <class S> S less_dots(S a, Vec3<S> b, Vec3<S> c, Vec3<S> d, Vec3<S> e) {
  return round_with_headroom<S>(widen<Sum<S>>(a) - dot_sum(b, c) - dot_sum(d, e));
}

/// Computes the accelerations and forces that spins and loads alone give a link.
template <class S>
void ArticulatedDynamics<S>::load(const ArticulatedTree<S>& tree, const std::vector<S>& speeds, std::size_t link) {
  const PreparedLink<S>& l = tree.links[link];
  LinkWork<S>& w = work_[link + 1];
  const Vec3<S> before = work_[l.parent].spin;
  w.carried = {cross(before, w.spin - before), cross(before, cross(before, w.arm))};
  if (l.type == ArticulationJoint::slider) {
    const Vec3<S> sideways = cross(before, w.axis * held_product(speeds[l.speed], tree.scale));
    w.carried.linear = held_sum(w.carried.linear, sideways + sideways);
  }
  const Vec3<S> outward = cross(w.spin, cross(w.spin, w.centre)) * l.mass;
  const Vec3<S> force = held_sum(outward, -w.load.force);
  const Vec3<S> turning = held_sum(held_cross(w.spin, held_times(w.inertia, w.spin)), -w.load.torque);
  w.bias = {held_sum(turning, held_cross(w.centre, force)), force};
}

template <class S> Wrench<S> ArticulatedDynamics<S>::passed_bias(const PreparedLink<S>& l, LinkWork<S>& w) {
  const JointWork<S>& j = w.joint;
  PointAcceleration<S> carried = w.carried;
  if (is_scalar(l.type)) {
    const bool turns = l.type == ArticulationJoint::hinge;
    const Vec3<S> own = turns ? w.bias.torque : w.bias.force;
    w.push = {round_with_headroom<S>(widen<SumOf<Unit<S>, S>>(j.force.x) - dot_sum(w.axis, own)), S(0), S(0)};
    if (j.stop != Stop::none) {
      Vec3<S>& moved = turns ? carried.angular : carried.linear;
      moved = held_sum(moved, w.axis * j.stop_answer);
      return w.bias + w.passed * carried;
    }
    const S x = Symmetric3<S>::quotient(w.push.x, w.pivot);
    const Wrench<S> moved = {held_product(w.column.torque, x), held_product(w.column.force, x)};
    return w.bias + w.passed * carried + moved;
  }
  if (l.type != ArticulationJoint::ball) return w.bias + w.passed * carried;
  w.push = held_sum(w.frame * j.force, -w.bias.torque);
  Vec3<S> x = w.pivots.solve(w.push);
  if (j.stop != Stop::none) {
    const S share = Symmetric3<S>::quotient(held_dot(w.stop_axis, x), w.stop_pivot);
    x = held_sum(x, -held_product(w.stop_answer, share));
    carried.angular = held_sum(carried.angular, held_product(w.stop_axis, j.stop_answer));
  }
  return w.bias + w.passed * carried + w.whole * PointAcceleration<S>{x, Vec3<S>::zero()};
}

template <class S> void ArticulatedDynamics<S>::pass_bias(const PreparedLink<S>& l, LinkWork<S>& w) {
  if (l.type == ArticulationJoint::free) return;
  const Wrench<S> passed = passed_bias(l, w);
  if (l.parent != 0) work_[l.parent].bias = work_[l.parent].bias + shifted(passed, w.arm);
}

template <class S> void ArticulatedDynamics<S>::answer_scalar(const PreparedLink<S>& l, LinkWork<S>& w) {
  JointWork<S>& j = w.joint;
  const bool turns = l.type == ArticulationJoint::hinge;
  PointAcceleration<S>& a = w.acceleration;
  const S rest = less_dots(w.push.x, w.column.torque, a.angular, w.column.force, a.linear);
  const S most = turns ? kMostTurn<S> : kMostSlide<S>;
  const bool stopped = j.stop != Stop::none;
  j.answer.x = stopped ? j.stop_answer : clamp(Symmetric3<S>::quotient(rest, w.pivot), -most, most);
  if (stopped) j.stop_force = with_headroom(saturating_subtract(held_product(w.pivot, j.stop_answer), rest));
  Vec3<S>& moved = turns ? a.angular : a.linear;
  moved = held_sum(moved, w.axis * j.answer.x);
}

template <class S> void ArticulatedDynamics<S>::answer_ball(LinkWork<S>& w) {
  JointWork<S>& j = w.joint;
  const Vec3<S> rest = held_sum(w.push, -torque_of(w.whole, w.acceleration));
  Vec3<S> x = w.pivots.solve(rest);
  if (j.stop != Stop::none) {
    const S missing = saturating_subtract(j.stop_answer, held_dot(w.stop_axis, x));
    j.stop_force = Symmetric3<S>::quotient(with_headroom(missing), w.stop_pivot);
    x = held_sum(x, held_product(w.stop_answer, j.stop_force));
  }
  x = held_within(x, kMostTurn<S>);
  j.answer = transposed_times(w.frame, x);
  w.acceleration.angular = held_sum(w.acceleration.angular, x);
}

/// Solves by blocks: (A - H M^-1 H^T) a = t - H M^-1 f,  M l = f - H^T a, for t, f against the bias.
template <class S> void ArticulatedDynamics<S>::answer_free(LinkWork<S>& w) {
  const Vec3<S> before = w.acceleration.linear;
  const Vec3<S> fall = w.pivots.solve(-w.bias.force);
  const Vec3<S> turn = w.turn_pivots.solve(held_sum(-w.bias.torque, -held_times(w.whole.coupling, fall)));
  const Mat3<S> back = transpose(w.whole.coupling);
  w.acceleration = {held_within(turn, kMostTurn<S>), held_sum(fall, -w.pivots.solve(held_times(back, turn)))};
  w.joint.answer = transposed_times(w.frame, w.acceleration.angular);
  w.slide = transposed_times(w.frame, held_sum(w.acceleration.linear, -before));
}

template <class S> void ArticulatedDynamics<S>::answer(const PreparedLink<S>& l, LinkWork<S>& w) {
  const PointAcceleration<S>& parent = work_[l.parent].acceleration;
  const Vec3<S> swung = held_sum(parent.linear, held_cross(parent.angular, w.arm));
  w.acceleration = {held_sum(parent.angular, w.carried.angular), held_sum(swung, w.carried.linear)};
  if (is_scalar(l.type)) answer_scalar(l, w);
  if (l.type == ArticulationJoint::ball) answer_ball(w);
  if (l.type == ArticulationJoint::free) answer_free(w);
  w.acceleration = {held_within(w.acceleration.angular, kMostTurn<S>),
                    held_within(w.acceleration.linear, kMostSlide<S>)};
}

template <class S>
void ArticulatedDynamics<S>::accelerate(const ArticulatedTree<S>& tree, const std::vector<S>& speeds) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) load(tree, speeds, i);
  for (std::size_t i = tree.links.size(); i-- > 0;) pass_bias(tree.links[i], work_[i + 1]);
  for (std::size_t i = 0; i < tree.links.size(); ++i) answer(tree.links[i], work_[i + 1]);
}

template <class S> bool ArticulatedDynamics<S>::choose(const ArticulatedTree<S>& tree, bool may_release) {
  bool changed = false;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const bool moves = is_scalar(tree.links[i].type) || tree.links[i].type == ArticulationJoint::ball;
    if (moves && work_[i + 1].joint.choose(tree, tree.links[i], may_release)) changed = true;
  }
  return changed;
}

template <class S>
bool ArticulatedDynamics<S>::quicken(const ArticulatedTree<S>& tree, const std::vector<S>& from, S share,
                                     std::vector<S>& to) const {
  bool fits = true;
  const auto ahead = [&](std::uint32_t at, S answer, S most) {
    const S asked = saturating_add(from[at], answer * tree.h * share);
    to[at] = clamp(asked, -most, most);
    if (!(to[at] == asked)) fits = false;
  };
  const S spin = S(4) * tree.spin;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const PreparedLink<S>& l = tree.links[i];
    const JointWork<S>& j = work_[i + 1].joint;
    const bool free = l.type == ArticulationJoint::free;
    if (l.type == ArticulationJoint::hinge) ahead(l.speed, j.answer.x, spin);
    if (l.type == ArticulationJoint::slider)
      ahead(l.speed, held_product(j.answer.x, tree.unscale), kMostSlideSpeed<S> * tree.unscale);
    for (std::uint32_t k = 0; k < 3 && has_rotation(l.type); ++k)
      ahead(l.speed + k + (free ? 3u : 0u), j.answer[static_cast<int>(k)], spin);
    for (std::uint32_t k = 0; k < 3 && free; ++k)
      ahead(l.speed + k, held_product(work_[i + 1].slide[static_cast<int>(k)], tree.unscale), Limits<S>::speed());
  }
  return fits;
}

template <class S>
void ArticulatedDynamics<S>::hold_limits(const ArticulatedTree<S>& tree, std::vector<S>& speeds) const {
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const PreparedLink<S>& l = tree.links[i];
    if (!l.limited || !is_scalar(l.type)) continue;
    const S unit = l.type == ArticulationJoint::slider ? tree.scale : S(1);
    const S back = l.type == ArticulationJoint::slider ? tree.unscale : S(1);
    const S now = held_product(speeds[l.speed], unit);
    const S held = work_[i + 1].joint.allowed(tree, l, now);
    if (!(held == now)) speeds[l.speed] = held_product(held, back);
  }
}

}  // namespace isostep::detail
