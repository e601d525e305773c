// WorldEngine: one step, stage by stage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/body_frames.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/step_solver.inl"

namespace isostep {

namespace detail {
template <class S> BeltPlace<S> place_of_belt(const BodyMap<S>& map, const SurfaceVelocity<S>& record) {
  const Location at = map.location(record.body.slot);
  const LeafRange leaves =
      record.part == kEveryPart ? LeafRange{kEveryPart, 0} : leaves_of_part(frame_at(map, at), record.part);
  return {map.state_at(at).orientation, map.properties_at(at).local_centre, leaves.first, leaves.count};
}
}  // namespace detail

template <class S> StepReport WorldEngine<S>::step(const StageObserver& observer) {
  const bool watched = observer.after != nullptr || desk_.trace != nullptr;
  return memory_ == nullptr || watched ? step_whole(observer) : memory_->step();
}

template <class S> StepReport WorldEngine<S>::step_whole(const StageObserver& observer) {
  const auto after = [&](Stage stage) {
    if (observer.after != nullptr) observer.after(observer.user, stage, view(static_cast<std::uint32_t>(stage)));
    desk_.note_hash(*this);
  };
  desk_.note_hash(*this);
  report_ = {};
  targets_.begin_step();
  mounts_.begin_step();
  find_pairs();
  tell_untold();
  after(Stage::find_pairs);
  render_poses_.keep_start();
  solver_.take_forces();
  after(Stage::apply_forces);
  find_contacts();
  after(Stage::update_manifolds);
  const bool watched = observer.after != nullptr || desk_.trace != nullptr;
  solver_.with_solver([&](auto& solver) { solve(solver, after, watched); });
  solver_.report_forces(report_);
  targets_.arrive();
  finisher_.finish(render_poses_.start(), solver_.cut(), tools_.runner, report_);
  after(Stage::finalise_bodies);
  continuous_.update(render_poses_.start(), narrow_phase_.joined_pairs(),
                     {&pair_rules_.ways(), &responses_.table(), &pair_rules_.kinds()});
  after(Stage::continuous);
  sensors_.update(narrow_phase_.overlaps(), events_);
  after(Stage::update_sensors);
  const SolvedContacts<S> solved = {narrow_phase_.old_contacts(), state_.contacts, narrow_phase_.geometry(),
                                    solver_.impulses(), responses_.all()};
  contact_events_.collect(solved, events_);
  break_events_.collect(solved, events_);
  joint_loads_.update(events_);
  hit_events_.collect(solved, events_);
  contact_points_.collect(solved, events_);
  after(Stage::emit_events);
  sleep_.update(events_.fell_asleep, render_poses_.start(), &belts_, solver_.pulls());
  after(Stage::update_sleep);
  characters_.update();
  targets_.end_step();
  mounts_.end_step();
  after(Stage::move_characters);
  ++state_.tick;
  return report_;
}

/// Finds pairs, and wakes touched islands, until no moving body touches a sleeping island.
template <class S> void WorldEngine<S>::find_pairs() {
  const auto budget = static_cast<std::size_t>(state_.settings.most_pairs);
  do proxies_.update(state_.contacts, budget);
  while (wake_.wake_touched());
  report_.crowded = proxies_.bodies_left_out();
}

template <class S> void WorldEngine<S>::find_contacts() {
  const Settings<S>& settings = state_.settings;
  const std::int32_t rate = integration_rate(settings.solver, settings.hz, settings.substeps);
  belts_.update(state_.records->surface_velocitys, min(Limits<S>::angular_speed(), S(rate)),
                [&](const SurfaceVelocity<S>& record) { return detail::place_of_belt(map_, record); });
  pair_rules_.update(proxies_.pairs());
  report_.cut_compounds = narrow_phase_.update(proxies_.pairs(), tools_, {pair_rules_.apart(), &belts_});
  responses_.update();
  hit_events_.measure(narrow_phase_.geometry());
  carriers_.update(state_.awake.states, state_.awake.properties, narrow_phase_.geometry(), rate, state_.contacts,
                   &belts_);
}

/// Reports the ends and wakings that commands caused since the last step, and the wakings of this step.
template <class S> void WorldEngine<S>::tell_untold() {
  events_.clear();
  events_.contact_end.swap(state_.untold.contact_end);
  events_.sensor_end.swap(state_.untold.sensor_end);
  tell_sleep();
}

/// Reports each body once. The list has an entry for every change of a body's sleep, and two changes cancel out.
template <class S> void WorldEngine<S>::tell_sleep() {
  std::vector<BodyId>& changed = state_.untold.woke;
  if (changed.empty()) return;
  change_of_.assign(state_.body_slots.entries().size(), 0);
  for (std::uint32_t i = 0; i < changed.size(); ++i) {
    std::uint32_t& last = change_of_[changed[i].slot];  // of the slot's body, after which it is no longer as it was
    if (last != 0 && changed[last - 1] == changed[i]) {
      changed[last - 1] = changed[i] = {};
      last = 0;
    } else {
      last = i + 1;
    }
  }
  for (const BodyId body : changed) {
    if (!body) continue;
    const bool sleeps = state_.body_slots.holds(body) && map_.location(body.slot).is_asleep();
    (sleeps ? events_.fell_asleep : events_.woke).push_back(body);
  }
  changed.clear();
}

/// Runs the stages from colour_constraints to store_impulses: the calls of rigid_solver.hpp.
template <class S>
template <class Solver, class After>
void WorldEngine<S>::solve(Solver& solver, const After& after, bool watched) {
  const StepContext<S> context = solver_.context(narrow_phase_.geometry(), carriers_.carried(), responses_.all(),
                                                 joint_loads_.impulses(), tools_, watched);
  solver.colour_constraints(context);
  after(Stage::colour_constraints);
  solver.prepare(context);
  after(Stage::prepare);
  solver.solve_substeps(context);
  after(Stage::solve_substeps);
  solver.store_impulses(context);
  report_.unsolved = solver.unsolved();
  after(Stage::store_impulses);
}

}  // namespace isostep

/// Instantiates the part of the engine that a game calls every frame. Its systems: *_systems.inl, acting_records.inl.
#define ISO_INSTANTIATE_WORLD_STEP(S) \
  ISO_STEP_SOLVER_OF(, S)             \
  ISO_ENGINE_OF(, S)
