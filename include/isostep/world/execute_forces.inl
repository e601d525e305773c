// The commands that push bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/world/command_executor.hpp"

namespace isostep {

namespace detail {
/// Forces and impulses have no range of their own: what they would do beyond the scalar's is cut, on exact products, so
/// that nothing wraps, and remembered, so that the step reports it.
template <class S> struct Bounder {
  using V = Velocity<S>;
  bool cut = false;

  S held(S x, S limit) {
    cut = cut || limit < x || x < -limit;
    return clamp(x, -limit, limit);
  }
  template <class Sum> S rounded(Sum sum, S limit) {
    const auto bound = product(limit, S(1));
    cut = cut || bound < sum || sum < -bound;
    return saturate_at<S>(sum, limit);
  }
  S quotient(S x, S divisor, S limit) {
    const auto value = product(x, S(1)), bound = product(limit, divisor);
    if (bound < value || value < -bound) {
      cut = true;
      return S(0) < x ? limit : -limit;
    }
    return held(x / divisor, limit);
  }
  Vec3<S> quotient(Vec3<S> v, S divisor, S limit) {
    return {quotient(v.x, divisor, limit), quotient(v.y, divisor, limit), quotient(v.z, divisor, limit)};
  }
  Vec3<S> times(const Mat3<S>& m, Vec3<S> v, S limit) {
    return {rounded(dot_sum(m.rows[0], v), limit), rounded(dot_sum(m.rows[1], v), limit),
            rounded(dot_sum(m.rows[2], v), limit)};
  }
  Vec3<S> sum(Vec3<S> a, Vec3<S> b, S limit) {  // twice the limit fits
    return {held(a.x + b.x, limit), held(a.y + b.y, limit), held(a.z + b.z, limit)};
  }
  Vec3<V> faster(Vec3<V> a, Vec3<S> b, S limit) {
    const V most = convert<V>(limit);
    const auto part = [&](V x, S y) {
      const V total = x + convert<V>(y);
      cut = cut || most < total || total < -most;
      return clamp(total, -most, most);
    };
    return {part(a.x, b.x), part(a.y, b.y), part(a.z, b.z)};
  }
  /// Turning by a torque or an angular impulse: moments that no format holds end at its highest (saturated_cross()).
  Vec3<S> turning(const Mat3<S>& kappa, Vec3<S> torque, S mass, S limit) {
    cut = cut || max_abs(torque) == highest<S>();
    return times(kappa, quotient(torque, mass, Limits<S>::mass()), limit);
  }
};

/// [rad/s] Twice as fast points of the body leave the range of velocities: rotates_too_fast(). `box` is the body's.
template <class S> S most_angular_speed(const Aabb<S>& box) {
  return min(Limits<S>::angular_speed(), S(0.5) * Limits<S>::surface_speed() / max(S(1), max_abs(box.high - box.low)));
}
}  // namespace detail

template <class S> bool CommandExecutor<S>::may_push(BodyId body) {
  if (!known(body)) return false;
  const bool pushable = map_.properties_at(map_.location(body.slot)).type == BodyType::dynamic;
  return pushable || journal_.refuse({Fault::not_dynamic, "", "body", "a dynamic one"});
}

template <class S> bool CommandExecutor<S>::execute(const ApplyForce<S>& command) {
  if (!journal_.accept(detail::Checklist().finite(command.force, "force").finite(command.torque, "torque").report()) ||
      !may_push(command.body)) {
    return false;
  }
  if (command.force == Vec3<S>::zero() && command.torque == Vec3<S>::zero()) return true;
  BodyState<S>& state = wake_.wake_for_change(command.body.slot);
  const BodyProperties<S>& body = state_.awake.properties[map_.location(state.slot).index];
  const Mat3<S> kappa = detail::world_kappa(body, detail::world_axes(state.orientation, body));
  // From rest to the limit in one step: velocities then stay within their format.
  const std::int32_t hz = state_.settings.hz;
  const S most = detail::most_acceleration(hz, Limits<S>::speed());
  const S most_turning = detail::most_acceleration(hz, detail::most_angular_speed(state.fat));
  PendingForce<S>& force = pending_force(state.slot);
  detail::Bounder<S> bounder;
  const Vec3<S> linear = bounder.quotient(command.force, body.mass, most);
  force.linear = bounder.sum(force.linear, linear, most);
  const Vec3<S> turning = bounder.turning(kappa, command.torque, body.mass, most_turning);
  force.angular = bounder.sum(force.angular, turning, most_turning);
  if (bounder.cut) force.cut = 1;
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const ApplyImpulse<S>& command) {
  if (!journal_.accept(
          detail::Checklist().finite(command.linear, "linear").finite(command.angular, "angular").report()) ||
      !may_push(command.body)) {
    return false;
  }
  if (command.linear == Vec3<S>::zero() && command.angular == Vec3<S>::zero()) return true;
  BodyState<S>& state = wake_.wake_for_change(command.body.slot);
  const BodyProperties<S>& body = state_.awake.properties[map_.location(state.slot).index];
  const Mat3<S> kappa = detail::world_kappa(body, detail::world_axes(state.orientation, body));
  // A quarter above the limit: the step then cuts them again and reports it.
  const S speed = Limits<S>::speed() * S(1.25), angular_speed = Limits<S>::angular_speed() * S(1.25);
  detail::Bounder<S> bounder;
  const Vec3<S> linear = bounder.quotient(command.linear, body.mass, S(2) * speed);
  state.velocity = bounder.faster(state.velocity, linear, speed);
  const Vec3<S> turning = bounder.turning(kappa, command.angular, body.mass, S(2) * angular_speed);
  state.angular_velocity = bounder.faster(state.angular_velocity, turning, angular_speed);
  if (bounder.cut) pending_force(state.slot).cut = 1;
  return true;
}

/// What is asked of a body until the next step.
template <class S> PendingForce<S>& CommandExecutor<S>::pending_force(std::uint32_t slot) {
  return find_or_insert(state_.forces, PendingForce<S>{slot, 0, Vec3<S>::zero(), Vec3<S>::zero()});
}

}  // namespace isostep
