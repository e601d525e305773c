// ParticleEngine: its state, and what each system leaves behind from stage to stage, by name.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "isostep/particles/particle_engine.hpp"
#include "isostep/state/fields.inl"

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

template <class S> template <class Visit> void FreeFlight<S>::visit_scratch(const Visit& visit) {
  visit("flight_rows", rows_);
}
template <class S> template <class Visit> void PairSearch<S>::visit_scratch(const Visit& visit) {
  visit("colliding", slots_);
  visit("reaches", reaches_);
}
template <class S> template <class Visit> void ParticleContacts<S>::visit_scratch(const Visit& visit) {
  visit("pairs", pairs_);
  visit("old_contacts", old_contacts_);
}
template <class S> template <class Visit> void ParticleRows<S>::visit_kinds(const Visit& visit) {
  visit("first_contact", first_contact_);
  visit("first_touch", first_touch_);
}
template <class S> template <class Visit> void ParticleRows<S>::visit_scratch(const Visit& visit) {
  visit("rows", rows_);
}
template <class S> template <class Visit> void ParticleSprings<S>::visit_scratch(const Visit& visit) {
  visit.within("spring_rows", [&](const auto& of_rows) { visit_spring_rows(of_rows, rows_); });
  visit("springs_yield", may_yield_);
}
template <class S> template <class Visit> void StiffSprings<S>::visit_scratch(const Visit& visit) {
  visit("oscillators", oscillators_);
}
template <class S> template <class Visit> void ParticleSoftStep<S>::visit_scratch(const Visit& visit) {
  visit("contact_softness", contact_softness_);
  visit("link_softness", link_softness_);
}

template <class S>
template <class Visit>
void ParticleEngine<S>::visit_scratch(const Visit& visit, ParticleStage stage) {
  switch (stage) {
    case ParticleStage::find_contacts:
      visit("h", step_.h);
      visit("rate", step_.rate);
      soft_step_.visit_scratch(visit);
      flight_.visit_scratch(visit);
      search_.visit_scratch(visit);
      contacts_.visit_scratch(visit);
      rows_.visit_kinds(visit);
      return rows_.visit_scratch(visit);
    case ParticleStage::solve_substeps:
      visit.within("displacement", [&](const auto& of_axes) { visit_axes(of_axes, step_.displacement); });
      springs_.visit_scratch(visit);
      stiff_springs_.visit_scratch(visit);
      return rows_.visit_scratch(visit);
    case ParticleStage::restitution: return rows_.visit_scratch(visit);
    case ParticleStage::store_impulses:
      visit("contact_begin", step_.events.contact_begin);
      return visit("touch_impulses", step_.events.touch_impulses);
    case ParticleStage::finalise_particles: return visit("report", step_.report);
    case ParticleStage::yield_springs: return visit("yielded", step_.events.yielded);
    case ParticleStage::expire_particles: return visit("expired", step_.events.expired);
  }
}

template <class S>
template <class Visit>
void ParticleEngine<S>::visit_fields(FieldGroup group, std::uint32_t stage, const Visit& visit) {
  if (group == FieldGroup::scratch) {
    if (stage < kParticleStages) visit_scratch(visit, static_cast<ParticleStage>(stage));
  } else {
    ParticleState<S>::members(StateFields(visit), state_);
  }
}

template <class S>
void ParticleEngine<S>::walk_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldSink& sink) {
  const FieldReading reading = {sink};
  static_cast<ParticleEngine*>(engine)->visit_fields(group, stage, FieldVisitor(nullptr, reading));
}

template <class S> StageView ParticleEngine<S>::view(std::uint32_t stage) {
  const auto hash = [](const void* engine) { return static_cast<const ParticleEngine*>(engine)->hash(); };
  return {{this, hash, &ParticleEngine::walk_fields}, stage};
}

}  // namespace isostep
