// ParticleEngine: its state and what each stage leaves behind, leaf by leaf.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "isostep/particles/particle_engine.hpp"
#include "isostep/state/leaves.inl"

namespace isostep {
namespace {

template <class Visit, class T> void visit_axes(const Visit& visit, Axes<T>& axes) {
  visit("x", axes.x);
  visit("y", axes.y);
  visit("z", axes.z);
}

/// The rows of this step: the arrays are as long as they ever were.
template <class Visit, class S> void visit_spring_rows(const Visit& visit, SpringRows<S>& rows) {
  const auto now = [&](auto& array) { return std::span(array.data(), rows.count); };
  visit("a", now(rows.a));
  visit("b", now(rows.b));
  visit("stiffness", now(rows.stiffness));
  visit("damping", now(rows.damping));
  visit("rest_length", now(rows.rest_length));
  visit("least_extension", now(rows.least_extension));
  visit("of_a", now(rows.of_a));
  visit("of_b", now(rows.of_b));
  visit("anchors", rows.anchors);
}

}  // namespace

template <class S>
template <class Visit>
void ParticleEngine<S>::visit_scratch(const Visit& visit, ParticleStage stage) {
  switch (stage) {
    case ParticleStage::find_contacts:
      visit("h", h_);
      visit("rate", rate_);
      visit("contact_softness", contact_softness_);
      visit("link_softness", link_softness_);
      visit("flight_rows", flight_rows_);
      visit("colliding", slots_);
      visit("reaches", reaches_);
      visit("pairs", pairs_);
      visit("old_contacts", old_contacts_);
      visit("first_contact", first_contact_);
      visit("first_touch", first_touch_);
      return visit("rows", rows_);
    case ParticleStage::solve_substeps:
      visit.within("displacement", [&](const auto& of_axes) { visit_axes(of_axes, scratch_.displacement); });
      visit.within("spring_rows", [&](const auto& of_rows) { visit_spring_rows(of_rows, spring_rows_); });
      visit("springs_yield", springs_yield_);
      visit("oscillators", oscillators_);
      return visit("rows", rows_);
    case ParticleStage::restitution: return visit("rows", rows_);
    case ParticleStage::store_impulses:
      visit("contact_begin", events_.contact_begin);
      return visit("touch_impulses", events_.touch_impulses);
    case ParticleStage::finalise_particles: return visit("report", report_);
    case ParticleStage::yield_springs: return visit("yielded", events_.yielded);
    case ParticleStage::expire_particles: return visit("expired", events_.expired);
  }
}

template <class S>
template <class Visit>
void ParticleEngine<S>::visit_leaves(LeafPart part, std::uint32_t stage, const Visit& visit) {
  if (part == LeafPart::scratch) {
    if (stage < kParticleStages) visit_scratch(visit, static_cast<ParticleStage>(stage));
  } else {
    ParticleState<S>::members(StateLeaves(visit), state_);
  }
}

template <class S>
void ParticleEngine<S>::walk_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafSink& sink) {
  const LeafReading reading = {sink};
  static_cast<ParticleEngine*>(engine)->visit_leaves(part, stage, LeafVisitor(nullptr, reading));
}

}  // namespace isostep
