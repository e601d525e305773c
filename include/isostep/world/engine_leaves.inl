// WorldEngine: its state and what each stage leaves behind, leaf by leaf.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>

#include "isostep/dynamics/solvers/solver_leaves.inl"
#include "isostep/state/leaves.inl"
#include "isostep/world/engine.hpp"

namespace isostep {
template <class S> template <class Visit> void WorldEngine<S>::visit_places(const Visit& visit) {
  visit("locations", std::span(locations_.data(), state_.body_slots.entries().size()));
  visit("joint_locations", std::span(joint_locations_.data(), state_.joint_slots.entries().size()));
}

template <class S> template <class Visit> void WorldEngine<S>::visit_manifolds(const Visit& visit) {
  visit("frames", frames_);
  visit("materials", materials_);
  visit("parts", parts_);
  visit("old_contacts", old_contacts_);
  visit("new_overlaps", new_overlaps_);
  visit.each("geometry", geometry_.size(), [&](const auto& of_contact, std::size_t i) {
    ContactGeometry<S>& g = geometry_[i];
    of_contact("row_a", g.row_a);
    of_contact("row_b", g.row_b);
    of_contact("normal", g.normal);
    of_contact("points", std::span(g.points, state_.contacts[i].count));
    of_contact("material", g.material);
  });
}

template <class S> template <class Visit> void WorldEngine<S>::visit_solver(const Visit& visit, SolverStage stage) {
  StepContext<S> context = {};
  context.properties = state_.awake.properties;
  context.contacts = state_.contacts;
  context.geometry = geometry_;
  with_solver(solvers_, state_.settings.solver, [&](auto& solver) { solver.visit_scratch(visit, stage, context); });
}

/// Of the broad phase the pairs: its trees are functions of the state and of what came before, and differ between
/// worlds that agree.
template <class S> template <class Visit> void WorldEngine<S>::visit_scratch(const Visit& visit, Stage stage) {
  switch (stage) {
    case Stage::find_pairs:
      visit("pairs", const_cast<std::vector<std::uint64_t>&>(proxies_.pairs()));  // a drill's to write
      return visit_places(visit);
    case Stage::apply_forces:
      visit("accelerations", accelerations_);
      visit("start_poses", start_poses_);
      return visit("start_slots", start_slots_);
    case Stage::update_manifolds: return visit_manifolds(visit);
    case Stage::colour_constraints: return visit_solver(visit, SolverStage::colour);
    case Stage::prepare: return visit_solver(visit, SolverStage::prepare);
    case Stage::solve_substeps: return visit_solver(visit, SolverStage::solve);
    case Stage::restitution: return visit_solver(visit, SolverStage::restitute);
    case Stage::store_impulses: visit("step_impulses", step_impulses_); return visit_solver(visit, SolverStage::store);
    case Stage::finalise_bodies: return visit("report", report_);
    case Stage::update_sensors:
      visit("sensor_begin", events_.sensor_begin);
      return visit("sensor_end", events_.sensor_end);
    case Stage::emit_events:
      visit("contact_begin", events_.contact_begin);
      return visit("contact_end", events_.contact_end);
    case Stage::update_sleep:
      visit("fell_asleep", events_.fell_asleep);
      visit("woke", events_.woke);
      return visit_places(visit);
  }
}

template <class S>
template <class Visit>
void WorldEngine<S>::visit_leaves(LeafPart part, std::uint32_t stage, const Visit& visit) {
  if (part == LeafPart::scratch) {
    if (stage < kStages) visit_scratch(visit, static_cast<Stage>(stage));
  } else {
    WorldState<S>::members(StateLeaves(visit), state_);
  }
}

template <class S>
void WorldEngine<S>::walk_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafSink& sink) {
  const LeafReading reading = {sink};
  static_cast<WorldEngine*>(engine)->visit_leaves(part, stage, LeafVisitor(nullptr, reading));
}

}  // namespace isostep
