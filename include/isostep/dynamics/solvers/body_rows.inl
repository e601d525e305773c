// Bodies of body_rows.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/gyroscopic.hpp"
#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/math/shortened.hpp"

namespace isostep {

namespace detail {

/// No motion along and about locked axes, whatever pushed.
template <class V> ISO_INLINE void hold_locks(std::uint32_t flags, MotionRow<V>& row) {
  if ((flags & body_flag::kAllLocks) == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    if ((flags & (body_flag::kLockX << axis)) != 0) row.linear[axis] = V(0);
    if ((flags & (body_flag::kLockAngularX << axis)) != 0) row.angular[axis] = V(0);
  }
}

template <class V> ISO_INLINE Pace pace_of(V angular_speed, bool solid, V rapid, V fast) {
  if (fast < angular_speed) return Pace::fast;
  return solid && !(rapid < angular_speed) ? Pace::slow : Pace::brisk;
}

}  // namespace detail

template <class S> void BodyRows<S>::gather(const StepContext<S>& context) {
  const std::size_t count = context.states.size();
  rows_.velocity.resize(count + 1);
  rows_.displacement.assign(count + 1, MotionRow<Velocity<S>>::zero());
  rows_.mass.resize(count + 1);
  start_.resize(count);
  gyro_.resize(count);
  const Velocity<S> fast = angular_speed_to_renew<S>(context.hz, true);
  began_with_followed_ = false;
  rows_.velocity[0] = MotionRow<Velocity<S>>::zero();
  rows_.mass[0] = {S(0), Mat3<S>::diagonal(Vec3<S>::zero())};
  for (std::size_t i = 0; i < count; ++i) {
    const BodyState<S>& state = context.states[i];
    const BodyProperties<S>& body = context.properties[i];
    start_[i] = state.centre;
    rows_.velocity[i + 1] = {state.velocity, Velocity<S>(0), state.angular_velocity, Velocity<S>(0)};
    SolverMass<S>& mass = rows_.mass[i + 1];
    if (body.type != BodyType::dynamic) {
      mass = rows_.mass[0];
      continue;
    }
    mass.mass = body.mass;
    if (fast < max_abs(state.angular_velocity)) {
      began_with_followed_ = began_with_followed_ || is_followed(context, static_cast<std::uint32_t>(i + 1));
    }
    const bool spins = (body.flags & body_flag::kSpins) != 0;
    const Mat3<Unit<S>> axes = spins ? detail::world_axes(state.orientation, body) : Mat3<Unit<S>>{};
    mass.kappa = detail::world_kappa(body, axes);
    if (!detail::turns_freely(body)) continue;
    const S least = min(body.kappa.x, min(body.kappa.y, body.kappa.z));
    const auto ratio = [&](S k) { return k > S(0) ? least / k : S(0); };
    const Vec3<S> inertia = {ratio(body.kappa.x), ratio(body.kappa.y), ratio(body.kappa.z)};
    const Vec3<S> euler = FreeTurn<S>::euler_of(inertia);
    gyro_[i] = {inertia, euler, FreeTurn<S>{axes, inertia, euler, {}}.local(state.angular_velocity),
                FreeTurn<S>::is_solid(euler)};
  }
}

template <class S>
void BodyRows<S>::integrate_velocities(const StepContext<S>& context, std::int32_t rate, std::size_t first,
                                       std::size_t end) {
  using V = Velocity<S>;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const V rapid = rapid_angular_speed<S>(context.hz), most = angular_speed_to_follow<S>(rate);
  const V fast = max(most, angular_speed_to_renew<S>(context.hz, false));
  const auto times = [](auto a, auto b) { return round_to<V>(product(a, b)); };
  for (std::size_t i = first; i < end; ++i) {
    const BodyProperties<S>& body = context.properties[i];
    if (body.type != BodyType::dynamic) continue;
    MotionRow<V>& row = rows_.velocity[i + 1];
    Vec3<S> acceleration = body.gravity_scale == S(1) ? context.gravity : context.gravity * body.gravity_scale;
    if (!context.accelerations.empty()) {
      acceleration += context.accelerations[i].linear;
      const Vec3<S> turning = context.accelerations[i].angular;
      row.angular += {times(turning.x, h), times(turning.y, h), times(turning.z, h)};
    }
    row.linear += {times(acceleration.x, h), times(acceleration.y, h), times(acceleration.z, h)};
    // Implicit: v' = v / (1 + h c), stable at any damping.
    if (body.linear_damping > S(0)) {
      const S keep = S(1) / (S(1) + body.linear_damping * h);
      row.linear = {times(keep, row.linear.x), times(keep, row.linear.y), times(keep, row.linear.z)};
    }
    if (body.angular_damping > S(0)) {
      const S keep = S(1) / (S(1) + body.angular_damping * h);
      row.angular = {times(keep, row.angular.x), times(keep, row.angular.y), times(keep, row.angular.z)};
    }
    if ((body.flags & body_flag::kSpins) == 0) {
      detail::hold_locks(body.flags, row);
      continue;
    }
    const Mat3<Unit<S>> axes = detail::world_axes(context.states[i].orientation, body);
    if (detail::turns_freely(body)) {
      Gyro& gyro = gyro_[i];
      const Pace pace = detail::pace_of(max_abs(row.angular), gyro.solid, rapid, fast);
      row.angular = FreeTurn<S>{axes, gyro.inertia, gyro.euler, h}.turn(row.angular, gyro.known, pace);
    }
    detail::hold_locks(body.flags, row);
    const V angular_speed = max_abs(row.angular);
    if (rapid < angular_speed && angular_speed < most) rows_.mass[i + 1].kappa = detail::world_kappa(body, axes);
  }
}

/// Looks first whether any is followed, or driven faster than the limit. Hardly ever is one: the loop that moves them
/// is spared the question.
template <class S>
bool BodyRows<S>::integrate_positions(const StepContext<S>& context, std::int32_t rate, std::size_t first,
                                      std::size_t end) {
  using V = Velocity<S>;
  const V fastest = angular_speed_limit<S>(rate);
  const V fast = min(angular_speed_to_renew<S>(context.hz, true), fastest * V(0.5));
  bool any_driven = false, any_followed = false;
  const MotionRow<V>* rows = rows_.velocity.data() + 1;
  for (std::size_t i = first; i < end; ++i) {
    const Vec3<V>& w = rows[i].angular;
    if (!(fast < max(w.x, max(w.y, w.z)) || min(w.x, min(w.y, w.z)) < -fast)) continue;
    if (limit_turn(context, rate, i)) any_followed = true;
    else if (fastest < max_abs(w)) any_driven = true;
  }
  if (any_followed || any_driven) move<true>(context, rate, first, end);
  else move<false>(context, rate, first, end);
  return any_followed;
}

/// Whether contacts are to follow the body.
template <class S> bool BodyRows<S>::limit_turn(const StepContext<S>& context, std::int32_t rate, std::size_t body) {
  if (context.properties[body].type != BodyType::dynamic) return false;
  MotionRow<Velocity<S>>& row = rows_.velocity[body + 1];
  detail::hold_locks(context.properties[body].flags, row);
  const Velocity<S> fastest = angular_speed_limit<S>(rate);
  if (detail::is_longer(row.angular, fastest)) {
    row.angular = detail::shortened(row.angular, fastest);
    if (!context.cut.empty()) context.cut[body] = 1;
  }
  return is_followed(context, static_cast<std::uint32_t>(body + 1));
}

template <class S>
template <bool Special>
void BodyRows<S>::move(const StepContext<S>& context, std::int32_t rate, std::size_t first, std::size_t end) {
  using V = Velocity<S>;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const V fastest = angular_speed_limit<S>(rate);
  const auto times = [](V a, Step<S> b) { return round_to<V>(product(a, b)); };
  for (std::size_t i = first; i < end; ++i) {
    MotionRow<V>& v = rows_.velocity[i + 1];
    detail::hold_locks(context.properties[i].flags, v);
    MotionRow<V>& d = rows_.displacement[i + 1];
    BodyState<S>& state = context.states[i];
    const Vec3<V> move = {times(v.linear.x, h), times(v.linear.y, h), times(v.linear.z, h)};
    const auto turn = [&](V w) { return round_to<Unit<S>>(product(Special ? clamp(w, -fastest, fastest) : w, h)); };
    // The centre follows the displacement, not the moves: where S is coarse, small moves add up before they round.
    d.linear += move;
    // The depth of contacts does not follow what turns so fast: the tangent of its arc would lead far from them.
    if (!Special || !is_followed(context, static_cast<std::uint32_t>(i + 1)))
      d.angular += {times(v.angular.x, h), times(v.angular.y, h), times(v.angular.z, h)};
    state.centre = start_[i] + convert<S>(d.linear);
    state.orientation =
        integrate(state.orientation, Vec3<Unit<S>>{turn(v.angular.x), turn(v.angular.y), turn(v.angular.z)});
  }
}

/// What is as easy to turn about each axis stays so however it turns.
template <class S>
bool BodyRows<S>::is_uneven(const BodyProperties<S>& body, std::int32_t hz, Velocity<S> angular_speed) {
  const Vec3<S> k = body.kappa;
  if (body.type != BodyType::dynamic || (k.x == k.y && k.y == k.z)) return false;
  const bool slender = min(k.x, min(k.y, k.z)) < max_abs(k) * S(1.0 / 16);
  return (body.flags & body_flag::kSpins) != 0 && (slender || angular_speed_to_renew<S>(hz, false) < angular_speed);
}
template <class S> void BodyRows<S>::renew_inertia(const StepContext<S>& context, std::uint32_t row) {
  const BodyProperties<S>& body = context.properties[row - 1];
  rows_.mass[row].kappa = detail::world_kappa(body, detail::world_axes(context.states[row - 1].orientation, body));
}

template <class S>
void BodyRows<S>::store(const StepContext<S>& context, std::int32_t rate, std::size_t first, std::size_t end) const {
  using V = Velocity<S>;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const V rapid = rapid_angular_speed<S>(context.hz);
  const V fast = max(angular_speed_to_follow<S>(rate), angular_speed_to_renew<S>(context.hz, false));
  for (std::size_t i = first; i < end; ++i) {
    BodyState<S>& state = context.states[i];
    const BodyProperties<S>& body = context.properties[i];
    MotionRow<V> row = rows_.velocity[i + 1];
    const bool turns = body.type == BodyType::dynamic && detail::turns_freely(body);
    if (turns && rapid < max_abs(row.angular)) {
      const Mat3<Unit<S>> axes = detail::world_axes(state.orientation, body);
      const Gyro& gyro = gyro_[i];
      const Pace pace = detail::pace_of(max_abs(row.angular), gyro.solid, rapid, fast);
      row.angular = FreeTurn<S>{axes, gyro.inertia, gyro.euler, h}.settle(row.angular, gyro.known, pace);
      detail::hold_locks(body.flags, row);
    }
    state.velocity = row.linear;
    state.angular_velocity = row.angular;
  }
}

}  // namespace isostep
