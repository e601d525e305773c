// WorldEngine: one step, stage by stage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/carriers.inl"
#include "isostep/world/body_forces.inl"
#include "isostep/world/body_finisher.inl"
#include "isostep/world/body_map.inl"
#include "isostep/world/break_events.inl"
#include "isostep/world/characters.inl"
#include "isostep/world/contact_events.inl"
#include "isostep/world/continuous_collision.inl"
#include "isostep/world/engine.hpp"
#include "isostep/world/explosion_forces.inl"
#include "isostep/world/island_sleep.inl"
#include "isostep/world/island_wake.inl"
#include "isostep/world/narrow_phase.inl"
#include "isostep/world/proxies.inl"
#include "isostep/world/render_poses.inl"
#include "isostep/world/resisting_forces.inl"
#include "isostep/world/sensor_overlaps.inl"
#include "isostep/world/step_solver.inl"
#include "isostep/world/water_forces.inl"
#include "isostep/world/wheel_forces.inl"

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
  render_poses_.keep_start();
  solver_.take_forces();
  after(Stage::apply_forces);
  report_.cut_compounds = narrow_phase_.update(proxies_.pairs(), tools_);
  const Settings<S>& settings = state_.settings;
  carriers_.update(state_.awake.states, state_.awake.properties, narrow_phase_.geometry(),
                   integration_rate(settings.solver, settings.hz, settings.substeps));
  after(Stage::update_manifolds);
  const bool watched = observer.after != nullptr || journal_.is_tracing();
  solver_.with_solver([&](auto& solver) { solve(solver, after, watched); });
  solver_.report_forces(report_);
  finisher_.finish(render_poses_.start(), solver_.cut(), report_);
  after(Stage::finalise_bodies);
  continuous_.update(render_poses_.start(), narrow_phase_.joined_pairs());
  after(Stage::continuous);
  sensors_.update(narrow_phase_.overlaps(), events_);
  after(Stage::update_sensors);
  const SolvedContacts<S> solved = {narrow_phase_.old_contacts(), state_.contacts, narrow_phase_.geometry(),
                                    solver_.impulses()};
  contact_events_.emit(solved, events_);
  break_events_.emit(solved, events_);
  after(Stage::emit_events);
  sleep_.update(events_.fell_asleep);
  after(Stage::update_sleep);
  characters_.update();
  after(Stage::move_characters);
  ++state_.tick;
  return report_;
}

/// Until nothing that moves touches a sleeping island.
template <class S> void WorldEngine<S>::find_pairs() {
  const auto budget = static_cast<std::size_t>(state_.settings.most_pairs);
  do proxies_.update(state_.contacts, budget);
  while (wake_.wake_touched());
  report_.crowded = proxies_.bodies_left_out();
}

/// What commands ended and woke since the last step, and what this one woke, is reported by this one.
template <class S> void WorldEngine<S>::tell_untold() {
  events_.clear();
  events_.contact_end.swap(state_.untold.contact_end);
  events_.sensor_end.swap(state_.untold.sensor_end);
  events_.woke.swap(state_.untold.woke);
}

/// From colour_constraints to store_impulses: the calls of rigid_solver.hpp.
template <class S>
template <class Solver, class After>
void WorldEngine<S>::solve(Solver& solver, const After& after, bool watched) {
  const StepContext<S> context = solver_.context(narrow_phase_.geometry(), carriers_.carried(), tools_, watched);
  solver.colour_constraints(context);
  after(Stage::colour_constraints);
  solver.prepare(context);
  after(Stage::prepare);
  solver.solve_substeps(context);
  after(Stage::solve_substeps);
  solver.apply_restitution(context);
  after(Stage::restitution);
  solver.store_impulses(context);
  report_.unsolved = solver.unsolved();
  after(Stage::store_impulses);
}

}  // namespace isostep

/// What a game calls every frame: the step, and the systems that it calls.
#define ISO_INSTANTIATE_WORLD_STEP(S)                                                                       \
  template class BodyMap<S>;                                                                                \
  template void detail::renew_fat_box<S>(const BodyMap<S>&, BodyState<S>&, const BodyProperties<S>&, bool); \
  template class Proxies<S>;                                                                                \
  template class IslandWake<S>;                                                                             \
  template class IslandSleep<S>;                                                                            \
  template class PartPairs<S>;                                                                              \
  template class NarrowPhase<S>;                                                                            \
  template class Carriers<S>;                                                                               \
  template class WheelForces<S>;                                                                            \
  template class BodyForces<S>;                                                                             \
  template class StepSolver<S>;                                                                             \
  template class BodyFinisher<S>;                                                                           \
  template class ContinuousCollision<S>;                                                                    \
  template class SensorOverlaps<S>;                                                                         \
  template class ContactEvents<S>;                                                                          \
  template class BreakEvents<S>;                                                                            \
  template class Characters<S>;                                                                             \
  template class RenderPoses<S>;                                                                            \
  template StepReport WorldEngine<S>::step(const StageObserver&);
