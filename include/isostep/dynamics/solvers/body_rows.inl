// Bodies of body_rows.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/gyroscopic.hpp"
#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/dynamics/solvers/energy_bound.inl"
#include "isostep/math/shortened.hpp"

namespace isostep {

namespace detail {

/// Stops motion along and about locked axes.
template <class V> ISO_INLINE void hold_locks(std::uint32_t flags, MotionRow<V>& row) {
  if ((flags & body_flag::kAllLocks) == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    if ((flags & (body_flag::kLockX << axis)) != 0) row.linear[axis] = V(0);
    if ((flags & (body_flag::kLockAngularX << axis)) != 0) row.angular[axis] = V(0);
  }
}

template <class S> ISO_INLINE std::uint8_t kind_of(const BodyProperties<S>& body) {
  std::uint8_t kind = (body.flags & body_flag::kAllLocks) != 0 ? body_kind::kLocked : std::uint8_t{0};
  if (body.type != BodyType::dynamic) return kind;
  kind |= body_kind::kDriven;
  if (body.linear_damping > S(0) || body.angular_damping > S(0)) kind |= body_kind::kDamped;
  if ((body.flags & body_flag::kSpins) != 0) kind |= body_kind::kSpins;
  if (turns_freely(body)) kind |= body_kind::kTurns;
  if (!(body.principal == Quat<Unit<S>>::identity())) kind |= body_kind::kTilted;
  return kind;
}

/// Returns the pace of a body that is not slow.
template <class S> ISO_INLINE Pace pace_of(Velocity<S> angular_speed, std::int32_t hz, std::int32_t rate) {
  const Velocity<S> fast = max(angular_speed_to_follow<S>(rate), angular_speed_to_renew<S>(hz, false));
  return fast < angular_speed ? Pace::fast : Pace::brisk;
}

}  // namespace detail

template <class S> void BodyRows<S>::begin(const StepContext<S>& context, std::int32_t rate) {
  const std::size_t count = context.states.size();
  rate_ = rate;
  rows_.velocity.resize(count + 1);
  rows_.displacement.resize(count + 1);
  rows_.mass.resize(count + 1);
  start_.resize(count);
  kinds_.resize(count);
  factors_.resize(count);
  flights_.resize(count);
  turns_.resize(count);
  left_.resize(count);
  rows_.velocity[0] = rows_.displacement[0] = MotionRow<Velocity<S>>::zero();
  rows_.mass[0] = {S(0), Mat3<S>::diagonal(Vec3<S>::zero())};
}
template <class S> bool BodyRows<S>::gather(const StepContext<S>& context, std::int32_t rate, bool binds_joints) {
  begin(context, rate);
  bind(context, binds_joints);
  const bool any_followed = gather_range(context, 0, context.states.size());
  for (const ContactGeometry<S>& g : context.geometry) {
    meet(g.row_a);
    meet(g.row_b);
  }
  return any_followed;
}

template <class S> bool BodyRows<S>::gather_range(const StepContext<S>& context, std::size_t first, std::size_t end) {
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate_));
  const Velocity<S> fast = angular_speed_to_renew<S>(context.hz, true);
  bool any_followed = false;
  // Implicit: v' = v / (1 + h c), stable at any damping.
  const auto keep = [h](S damping) ISO_INLINE_LAMBDA { return damping > S(0) ? S(1) / (S(1) + damping * h) : S(1); };
  const auto fall = [h](S acceleration) ISO_INLINE_LAMBDA { return round_to<Velocity<S>>(product(acceleration, h)); };
  for (std::size_t i = first; i < end; ++i) {
    const BodyState<S>& state = context.states[i];
    const BodyProperties<S>& body = context.properties[i];
    start_[i] = state.centre;
    rows_.velocity[i + 1] = {state.velocity, Velocity<S>(0), state.angular_velocity, Velocity<S>(0)};
    rows_.displacement[i + 1] = MotionRow<Velocity<S>>::zero();
    kinds_[i] = detail::kind_of(body);
    factors_[i] = {keep(body.linear_damping), keep(body.angular_damping), {}};
    flights_[i] = {};
    SolverMass<S>& mass = rows_.mass[i + 1];
    if (body.type != BodyType::dynamic) {
      mass = rows_.mass[0];
      continue;
    }
    mass.mass = body.mass;
    flights_[i].fall = {fall(context.gravity.x * body.gravity_scale), fall(context.gravity.y * body.gravity_scale),
                        fall(context.gravity.z * body.gravity_scale)};
    if (fast < max_abs(state.angular_velocity))
      any_followed = any_followed || is_followed(context, static_cast<std::uint32_t>(i + 1));
    const bool spins = (body.flags & body_flag::kSpins) != 0;
    const Mat3<Unit<S>> axes = spins ? detail::world_axes(state.orientation, body) : Mat3<Unit<S>>{};
    const bool rapid = spins && rapid_angular_speed<S>(context.hz) < max_abs(state.angular_velocity);
    mass.kappa = detail::world_kappa(body, rapid ? axes_in_the_middle(context, i) : axes);
    if (detail::turns_freely(body)) gather_turn(state, body, axes, i);
  }
  return any_followed;
}

/// Returns the principal axes in the middle of the step, as the body turns now, since contacts use one inertia for the
/// whole step. With the inertia of its start they respond late, and a barrel that rolls on its rim gains energy. A body
/// that contacts follow has the axes of the first sub-step: they are renewed before the second.
template <class S> Mat3<Unit<S>> BodyRows<S>::axes_in_the_middle(const StepContext<S>& context, std::size_t i) const {
  const BodyState<S>& state = context.states[i];
  const bool followed = is_followed(context, static_cast<std::uint32_t>(i + 1));
  const Step<S> half = divide_to<Step<S>>(S(0.5), S(followed ? rate_ : context.hz));
  const auto turn = [half](Velocity<S> w) { return round_within<Unit<S>>(product(w, half), Unit<S>(1)); };
  const Vec3<Velocity<S>> w = state.angular_velocity;
  return detail::world_axes(integrate(state.orientation, Vec3<Unit<S>>{turn(w.x), turn(w.y), turn(w.z)}),
                            context.properties[i]);
}

template <class S>
void BodyRows<S>::gather_turn(const BodyState<S>& state, const BodyProperties<S>& body, const Mat3<Unit<S>>& axes,
                              std::size_t i) {
  const S least = min(body.kappa.x, min(body.kappa.y, body.kappa.z));
  const auto ratio = [least](S k) { return k > S(0) ? least / k : S(0); };
  BodyTurn<S>& turn = turns_[i];
  turn.inertia = {ratio(body.kappa.x), ratio(body.kappa.y), ratio(body.kappa.z)};
  turn.euler = FreeTurn<S>::euler_of(turn.inertia);
  turn.known = transposed_times(axes, state.angular_velocity);
  if (FreeTurn<S>::is_solid(turn.euler)) kinds_[i] |= body_kind::kSolid;
}

template <class S> BodyRun<S> BodyRows<S>::run_of(const StepContext<S>& context, std::size_t first, std::size_t end) {
  return {first,
          end,
          divide_to<Step<S>>(S(1), S(rate_)),
          rapid_angular_speed<S>(context.hz),
          min(angular_speed_to_renew<S>(context.hz, true), angular_speed_limit<S>(rate_) * Velocity<S>(0.5)),
          context.accelerations.empty() ? nullptr : context.accelerations.data(),
          context.states.data(),
          context.properties.data(),
          rows_.velocity.data() + 1,
          rows_.displacement.data() + 1,
          start_.data(),
          kinds_.data(),
          factors_.data(),
          flights_.data(),
          turns_.data(),
          left_.data()};
}

template <class S>
void BodyRows<S>::integrate_velocities(const StepContext<S>& context, std::size_t first, std::size_t end) {
  if (!context.accelerations.empty()) bound_.add_work(context, rows_, first, end);
  const std::size_t left = context.body_kernels->integrate_velocities(run_of(context, first, end));
  for (std::size_t k = first; k < first + left; ++k) finish_velocity(context, left_[k] / 2, left_[k] % 2 == 0);
}

template <class S> void BodyRows<S>::finish_velocity(const StepContext<S>& context, std::size_t body, bool turned) {
  using V = Velocity<S>;
  const BodyProperties<S>& properties = context.properties[body];
  MotionRow<V>& row = rows_.velocity[body + 1];
  const bool spins = (kinds_[body] & body_kind::kSpins) != 0;
  if (!spins) return detail::hold_locks(properties.flags, row);
  const V rapid = rapid_angular_speed<S>(context.hz), most = angular_speed_to_follow<S>(rate_);
  const Mat3<Unit<S>> axes = detail::world_axes(context.states[body].orientation, properties);
  if (!turned) {
    BodyTurn<S>& turn = turns_[body];
    // Damping is no push: as one, of what it all but stops more would be taken back than is left.
    const S kept = factors_[body].angular_keep;
    for (int axis = 0; axis < 3; ++axis) turn.known[axis] = round_to<V>(product(kept, turn.known[axis]));
    const Pace pace = detail::pace_of<S>(max_abs(row.angular), context.hz, rate_);
    const Step<S> h = divide_to<Step<S>>(S(1), S(rate_));
    row.angular = FreeTurn<S>{axes, turn.inertia, turn.euler, h}.turn(row.angular, turn.known, pace);
  }
  detail::hold_locks(properties.flags, row);
  const V angular_speed = max_abs(row.angular);
  // Joints that turn a body by an inertia of before give it energy: a light capsule at 66 rad/s on a ball joint went
  // from 33 J to 459 J in ten seconds. Bodies that touch something do not follow: see angular_speed_to_follow().
  const bool follows = (kinds_[body] & body_kind::kMet) == 0 || angular_speed < most;
  if (rapid < angular_speed && follows) rows_.mass[body + 1].kappa = detail::world_kappa(properties, axes);
}

template <class S>
bool BodyRows<S>::integrate_positions(const StepContext<S>& context, std::size_t first, std::size_t end) {
  const std::size_t left = context.body_kernels->integrate_positions(run_of(context, first, end));
  bool any_followed = false;
  for (std::size_t k = first; k < first + left; ++k) {
    const std::size_t body = left_[k] / 2;
    if (left_[k] % 2 != 0 && limit_turn(context, body)) any_followed = true;
    move(context, body);
  }
  return any_followed;
}

/// Limits the turn of a body. Returns true if contacts must follow the body.
template <class S> bool BodyRows<S>::limit_turn(const StepContext<S>& context, std::size_t body) {
  if (context.properties[body].type != BodyType::dynamic) return false;
  MotionRow<Velocity<S>>& row = rows_.velocity[body + 1];
  detail::hold_locks(context.properties[body].flags, row);
  const Velocity<S> fastest = angular_speed_limit<S>(rate_);
  if (detail::is_longer(row.angular, fastest)) {
    row.angular = detail::shortened(row.angular, fastest);
    if (!context.cut.empty()) context.cut[body] = 1;
  }
  return is_followed(context, static_cast<std::uint32_t>(body + 1));
}

/// Does the same as the kernel, also for bodies that are locked or fast.
template <class S> void BodyRows<S>::move(const StepContext<S>& context, std::size_t body) {
  using V = Velocity<S>;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate_));
  const V fastest = angular_speed_limit<S>(rate_);
  MotionRow<V>& v = rows_.velocity[body + 1];
  detail::hold_locks(context.properties[body].flags, v);
  MotionRow<V>& d = rows_.displacement[body + 1];
  BodyState<S>& state = context.states[body];
  const auto times = [h](V a) { return round_to<V>(product(a, h)); };
  const BodyFlight<S>& flight = flights_[body];
  Vec3<V> mean = v.linear;
  for (int axis = 0; axis < 3 && v.linear == flight.fallen; ++axis)
    mean[axis] = v.linear[axis] - round_to<V>(product(S(0.5), flight.fall[axis]));
  d.linear += {times(mean.x), times(mean.y), times(mean.z)};
  // The depth of contacts does not follow what turns so fast: the tangent of its arc would lead far from them.
  if (!is_followed(context, static_cast<std::uint32_t>(body + 1)))
    d.angular += {times(v.angular.x), times(v.angular.y), times(v.angular.z)};
  state.centre = start_[body] + convert<S>(d.linear);
  const auto turn = [h, fastest](V w) { return round_to<Unit<S>>(product(clamp(w, -fastest, fastest), h)); };
  state.orientation =
      integrate(state.orientation, Vec3<Unit<S>>{turn(v.angular.x), turn(v.angular.y), turn(v.angular.z)});
}

/// Returns true if the body's inertia about world axes changes as it turns. With equal moments it never does.
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

template <class S> void BodyRows<S>::store(const StepContext<S>& context, std::size_t first, std::size_t end) const {
  using V = Velocity<S>;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate_));
  const V rapid = rapid_angular_speed<S>(context.hz);
  for (std::size_t i = first; i < end; ++i) {
    BodyState<S>& state = context.states[i];
    MotionRow<V> row = rows_.velocity[i + 1];
    const BodyProperties<S>& body = context.properties[i];
    if ((kinds_[i] & body_kind::kTurns) != 0 && rapid < max_abs(row.angular)) {
      const Mat3<Unit<S>> axes = detail::world_axes(state.orientation, body);
      const BodyTurn<S>& turn = turns_[i];
      const Pace pace = detail::pace_of<S>(max_abs(row.angular), context.hz, rate_);
      row.angular = FreeTurn<S>{axes, turn.inertia, turn.euler, h}.settle(row.angular, turn.known, pace);
      detail::hold_locks(body.flags, row);
    }
    state.velocity = row.linear;
    state.angular_velocity = row.angular;
  }
}

}  // namespace isostep
