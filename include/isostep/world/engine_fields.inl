// WorldEngine: its state and what each stage leaves behind, field by field.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>

#include "isostep/dynamics/solvers/solver_fields.inl"
#include "isostep/state/fields.inl"
#include "isostep/world/engine.hpp"
#if !defined(ISOSTEP_NO_BOOK)
#include "isostep/book/worst_first_fields.inl"
#endif

namespace isostep {

/// Visits only the pairs of the broad phase. Its trees depend on the history too, and differ between worlds with equal
/// states.
template <class S> template <class Visit> void WorldEngine<S>::visit_scratch(const Visit& visit, Stage stage) {
  const auto solved = [&](SolverStage part) { solver_.visit_solver(visit, part, narrow_phase_.geometry()); };
  switch (stage) {
    case Stage::find_pairs: proxies_.visit_scratch(visit); return map_.visit_scratch(visit);
    case Stage::apply_forces: solver_.visit_forces(visit); return render_poses_.visit_scratch(visit);
    case Stage::update_manifolds: responses_.visit_scratch(visit); return narrow_phase_.visit_scratch(visit);
    case Stage::colour_constraints: return solved(SolverStage::colour);
    case Stage::prepare: return solved(SolverStage::prepare);
    case Stage::solve_substeps: return solved(SolverStage::solve);
    case Stage::store_impulses: solver_.visit_impulses(visit); return solved(SolverStage::store);
    case Stage::finalise_bodies: return visit("report", report_);
    case Stage::continuous: return;
    case Stage::update_sensors:
      visit("sensor_begin", events_.sensor_begin);
      return visit("sensor_end", events_.sensor_end);
    case Stage::emit_events:
      visit("contact_begin", events_.contact_begin);
      visit("broke", events_.broke);
      visit("joint_broke", events_.joint_broke);
      if (!events_.hits.empty()) visit("hits", events_.hits);
      if (!events_.contacts.empty()) visit("contacts", events_.contacts);
      return visit("contact_end", events_.contact_end);
    case Stage::update_sleep:
      visit("fell_asleep", events_.fell_asleep);
      visit("woke", events_.woke);
      return map_.visit_scratch(visit);
    case Stage::move_characters: return map_.visit_scratch(visit);
  }
}

template <class S>
template <class Visit>
void WorldEngine<S>::visit_fields(FieldGroup group, std::uint32_t stage, const Visit& visit) {
  if (group == FieldGroup::scratch) {
    if (stage < kStages) visit_scratch(visit, static_cast<Stage>(stage));
  } else {
    WorldState<S>::members(StateFields(visit), state_);
  }
}

template <class S>
void WorldEngine<S>::walk_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldSink& sink) {
  const FieldReading reading = {sink};
  static_cast<WorldEngine*>(engine)->visit_fields(group, stage, FieldVisitor(nullptr, reading));
}

template <class S> StageView WorldEngine<S>::view(std::uint32_t stage) {
  const auto hash = [](const void* engine) { return static_cast<const WorldEngine*>(engine)->hash(); };
  return {{this, hash, &WorldEngine::walk_fields}, stage};
}

}  // namespace isostep
