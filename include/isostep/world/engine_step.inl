// WorldEngine: one step, stage by stage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/solvers.inl"
#include "isostep/world/checks.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

template <class S> StepReport WorldEngine<S>::step(const StageObserver& observer) {
  const auto after = [&](Stage stage) {
    if (observer.after != nullptr) observer.after(observer.user, stage, view(static_cast<std::uint32_t>(stage)));
    journal_.trace(*this);
  };
  journal_.trace(*this);
  report_ = {};
  find_pairs();
  tell_untold();
  after(Stage::find_pairs);
  apply_forces();
  after(Stage::apply_forces);
  update_manifolds();
  after(Stage::update_manifolds);
  const bool watched = observer.after != nullptr || journal_.is_tracing();
  with_solver(solvers_, state_.settings.solver, [&](auto& solver) { solve(solver, after, watched); });
  finalise_bodies();
  after(Stage::finalise_bodies);
  update_sensors();
  after(Stage::update_sensors);
  emit_contact_events();
  after(Stage::emit_events);
  update_sleep();
  after(Stage::update_sleep);
  ++state_.tick;
  return report_;
}

template <class S> StageView WorldEngine<S>::view(std::uint32_t stage) {
  const auto hash = [](const void* engine) { return static_cast<const WorldEngine*>(engine)->hash(); };
  return {{this, hash, &WorldEngine::walk_leaves}, stage};
}

/// From colour_constraints to store_impulses.
template <class S>
template <class Solver, class After>
void WorldEngine<S>::solve(Solver& solver, const After& after, bool watched) {
  const StepContext<S> context = solver_context(watched);
  solver.colour_constraints(context);
  after(Stage::colour_constraints);
  solver.prepare(context);
  if (watched) after(Stage::prepare);
  solver.solve_substeps(context);
  if (watched) after(Stage::solve_substeps);
  solver.restitute(context);
  if (watched) after(Stage::restitution);
  solver.store_impulses(context);
  report_.unsolved = solver.unsolved();
  after(Stage::store_impulses);
}

/// What commands ended and woke since the last step, and what this one woke, is told by this one.
template <class S> void WorldEngine<S>::tell_untold() {
  events_.clear();
  events_.contact_end.swap(state_.untold.contact_end);
  events_.sensor_end.swap(state_.untold.sensor_end);
  events_.woke.swap(state_.untold.woke);
}

template <class S> void WorldEngine<S>::apply_forces() {
  start_poses_.resize(state_.awake.states.size());
  start_slots_.resize(start_poses_.size());
  for (std::size_t i = 0; i < start_poses_.size(); ++i) {
    start_poses_[i] = {state_.awake.states[i].centre, state_.awake.states[i].orientation};
    start_slots_[i] = state_.awake.states[i].slot;
  }
  accelerations_.clear();
  if (state_.forces.empty()) return;
  accelerations_.resize(state_.awake.states.size(), Acceleration<S>{Vec3<S>::zero(), Vec3<S>::zero()});
  for (const PendingForce<S>& force : state_.forces) {
    accelerations_[locations_[force.slot].index] = {force.linear, force.angular};
    report_.clamped_force += force.cut;
  }
  state_.forces.clear();
}

template <class S> StepContext<S> WorldEngine<S>::solver_context(bool watched) {
  const auto end_at = [&](std::uint32_t slot) { return JointEnd<S>{row_of(slot), centre_pose_at(slot)}; };
  joint_ends_.resize(state_.joints.properties.size());
  for (std::size_t i = 0; i < joint_ends_.size(); ++i) {
    const JointProperties<S>& joint = state_.joints.properties[i];
    joint_ends_[i] = {end_at(joint.body_a), end_at(joint.body_b)};
  }
  step_impulses_.resize(state_.contacts.size());
  return {state_.awake.states,
          state_.awake.properties,
          accelerations_,
          state_.contacts,
          geometry_,
          step_impulses_,
          state_.joints.properties,
          state_.joints.states,
          joint_ends_,
          state_.settings.gravity,
          state_.settings.hz,
          state_.settings.substeps,
          watched,
          runner_,
          kernels_,
          tree_kernels_,
          carried_};
}

template <class S> void WorldEngine<S>::finalise_bodies() {
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) finish_body(i);
  if (report_.stopped > 0) discard_bad_impulses();
}

/// A body that was stopped leaves contacts and joints behind whose impulses are no numbers either.
template <class S> void WorldEngine<S>::discard_bad_impulses() {
  using V = Velocity<S>;
  for (Contact<S>& contact : state_.contacts) {
    bool finite = is_finite(contact.friction_impulse) && is_finite(contact.twist_impulse);
    for (const V impulse : contact.normal_impulse) finite = finite && is_finite(impulse);
    if (finite) continue;
    for (V& impulse : contact.normal_impulse) impulse = V(0);
    contact.friction_impulse = Vec3<V>::zero();
    contact.twist_impulse = V(0);
  }
  for (JointState<S>& joint : state_.joints.states) {
    const bool finite =
        is_finite(joint.point) && is_finite(joint.angular) && is_finite(joint.drive) && is_finite(joint.swing);
    if (finite) continue;
    JointState<S> fresh = {};
    fresh.slot = joint.slot;
    joint = fresh;
  }
}

namespace detail {
/// Most are not half as long along any axis, and need no square root.
template <class V> bool is_longer(Vec3<V> v, V limit) { return limit * V(0.5) < max_abs(v) && limit < length(v); }
/// To `limit`, or to 2^-12 less where rounding leads beyond.
template <class V> Vec3<V> shortened(Vec3<V> v, V limit) {
  if (!is_longer(v, limit)) return v;
  const auto way = direction_of(v.x, v.y, v.z);
  const auto along = [&](V length) {
    const auto part = [&](auto x) { return round_to<V>(product(length, x)); };
    return Vec3<V>{part(way.x), part(way.y), part(way.z)};
  };
  const Vec3<V> cut = along(limit);
  return is_longer(cut, limit) ? along(limit - limit * V(0x1p-12)) : cut;
}
}  // namespace detail

/// Nothing leaves the scalar's range and no NaN enters the state: what would is cut, put back or stopped, and reported.
template <class S> void WorldEngine<S>::finish_body(std::size_t index) {
  using V = Velocity<S>;
  BodyState<S>& state = state_.awake.states[index];
  const auto& q = state.orientation;
  const bool finite = is_finite(state.centre) && is_finite(state.velocity) && is_finite(state.spin) && is_finite(q.x) &&
                      is_finite(q.y) && is_finite(q.z) && is_finite(q.w);
  if (!finite) {
    state.centre = start_poses_[index].position;
    state.orientation = start_poses_[index].orientation;
    state.velocity = Vec3<V>::zero();
    state.spin = Vec3<V>::zero();
    ++report_.stopped;
  }
  const V speed = convert<V>(Limits<S>::speed());
  const V spin = spin_limit<S>(integration_rate(state_.settings.solver, state_.settings.hz, state_.settings.substeps));
  const bool overspins = detail::overspins(state.spin, state.fat);
  if (detail::is_longer(state.velocity, speed) || detail::is_longer(state.spin, spin) || overspins) {
    const S most = overspins ? Limits<S>::surface_speed() / max_abs(state.fat.high - state.fat.low) : Limits<S>::spin();
    state.velocity = detail::shortened(state.velocity, speed);
    state.spin = detail::shortened(state.spin, min(spin, convert<V>(most)));
    ++report_.clamped_speed;
  }
  const S edge = Limits<S>::position();
  if (edge < max_abs(state.centre)) {
    const Vec3<S> c = state.centre;
    state.centre = {clamp(c.x, -edge, edge), clamp(c.y, -edge, edge), clamp(c.z, -edge, edge)};
    for (int axis = 0; axis < 3; ++axis) {
      if (!(state.centre[axis] == c[axis])) state.velocity[axis] = V(0);
    }
    ++report_.clamped_position;
  }
  const BodyProperties<S>& body = state_.awake.properties[index];
  renew_fat_box(state, body, false);
  proxies_.place(state, body, true);
}

}  // namespace isostep
