// WorstFirstStep: a sub-step, and its division.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/solvers/time_to_contact.hpp"
#include "isostep/particles/solvers/worst_first_step.hpp"
#include "isostep/particles/step/row_motion.hpp"

namespace isostep {

template <class S>
WorstFirstStep<S>::WorstFirstStep(ParticleState<S>& state, ParticleStep<S>& step, ParticleRows<S>& rows,
                                  ParticleIntegration<S>& integration)
    : state_(state), step_(step), rows_(rows), integration_(integration) {}

template <class S> void WorstFirstStep<S>::begin_step() {
  looks_left_ = iteration_budget(state_.settings.looks, state_.material.size());
}

template <class S> void WorstFirstStep<S>::solve_substep() {
  integrate_velocities();
  if (state_.settings.stepping == Stepping::time_division) {
    divide_way();
  } else {
    resolve();
    for (std::uint32_t i = 0; i < state_.material.size(); ++i) step_.move_on(i, way_[i]);
    step_.follow_constraints(state_.velocity, before_);
  }
  if (!integration_.arrives()) return;
  // A contact that is pressed by the other half of the forces must not leave with it.
  before_ = state_.velocity;
  integration_.arrive(!rows_.empty());
  note_gained();
  integration_.place();
  resolve();
}

/// Integrates velocities and stores the way apart. Resolution happens between the two, so that friction may undo
/// gravity's way along a slope.
template <class S> void WorstFirstStep<S>::integrate_velocities() {
  before_ = state_.velocity;
  start_ = step_.displacement;
  integration_.integrate(!rows_.empty());
  note_gained();
  way_.resize(state_.material.size());
  for (std::uint32_t i = 0; i < state_.material.size(); ++i)
    way_.set(i, saturating_subtract(step_.displacement[i], start_[i]));
  step_.displacement = start_;
  integration_.place();
}
/// Notes what forces added to the velocities since `before_`, which are `before_` from now on.
template <class S> void WorstFirstStep<S>::note_gained() {
  gained_.resize(state_.material.size());
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const bool moves = InverseMass<S>(0) < state_.inverse_mass[i];
    gained_.set(i, moves ? saturating_subtract(state_.velocity[i], before_[i]) : Vec3<V>::zero());
  }
  before_ = state_.velocity;
}

template <class S> void WorstFirstStep<S>::resolve() {
  place_rows();
  resolve_rows();
  pay_for_ways();
}
/// Rows as WorstFirst has them: separations as the step began. What rounding alone keeps apart touches.
template <class S> void WorstFirstStep<S>::place_rows() {
  rows_.look();
  const Axes<V>& d = step_.displacement;
  for (Row& row : rows_.all()) {
    row.shift = max(-saturate_to<V>(product(row.separation, step_.rate)), V(0));
    if (is_touching(row)) row.separation = min(row.separation, S(0));
    const auto of_b = dot_sum(row.normal, row.b == kNoParticle ? Vec3<V>::zero() : d[row.b]);
    row.separation -= convert<S>(saturate_to<V>(of_b - dot_sum(row.normal, d[row.a])));
  }
}
template <class S> ISO_INLINE bool WorstFirstStep<S>::is_touching(const Row& row) const {
  const S tolerance = spacing_at(max_abs(step_.now[row.a])) * S(16);
  return row.kind == ConstraintKind::contact && row.separation <= tolerance;
}
template <class S> void WorstFirstStep<S>::resolve_rows() {
  const std::span<Row> rows = rows_.all();
  const std::uint32_t asked = state_.settings.iterations;
  const bool arrives = integration_.arrives();
  ResolverTerms<S> terms = {arrives ? step_.rate + step_.rate : step_.rate, !arrives, std::nullopt, looks_left_};
  if (asked != 0) terms.iterations = asked;
  step_.report.unresolved += resolver_.resolve(rows.data(), static_cast<std::uint32_t>(rows.size()), state_.velocity,
                                               step_.displacement, gained_, terms);
  spend(resolver_.looks());
  for (Row& row : rows) row.impulse_seen = max(row.impulse_seen, row.impulse);
}
/// Subtracts looks from the budget of the step.
template <class S> void WorstFirstStep<S>::spend(std::uint64_t looks) {
  if (looks_left_ <= looks && looks != 0) ++step_.report.spent;
  looks_left_ -= min(looks, looks_left_);
}

/// A particle that came back out of an overlap has its speed from where it was. Where the forces that it was pushed
/// against are stronger at the surface than they were there, the difference is to be paid too.
template <class S> void WorstFirstStep<S>::pay_for_ways() {
  const auto pays = [](const Row& row) {
    return V(0) < row.shift && S(0) < row.restitution && V(0) < row.impulse && row.kind != ConstraintKind::rod;
  };
  bool any = false;
  for (const Row& row : rows_.all()) any = any || pays(row);
  if (!any || !integration_.has_forces()) return;
  integration_.accelerate_all();
  for (Row& row : rows_.all()) {
    const V speed = detail::separating_speed(row, state_.velocity);
    if (!pays(row) || !(V(0) < speed)) continue;
    const Vec3<V> of_b = row.b == kNoParticle ? row.surface_gain : gained_[row.b];
    V paid = saturate_to<V>(dot_sum(row.normal, gained_[row.a]) - dot_sum(row.normal, of_b));
    if (integration_.arrives()) paid = saturating_add(paid, paid);
    const V more = saturating_subtract(detail::closing_gain(row, step_.acceleration, step_.h), max(paid, V(0)));
    if (!(V(0) < more)) continue;
    const V kept = worked_speed<S>(speed, -more, row.shift);
    detail::give(row, state_.velocity, row.normal * saturating_subtract(kept, speed));
  }
}

// ---- time division

template <class S> void WorstFirstStep<S>::divide_way() {
  U left = U(1);  // [1] of the sub-step
  for (std::uint32_t division = 0;; ++division) {
    resolve();
    turn_ways(left);
    integration_.place();
    rows_.look();
    U when;
    const bool divides = division < kMostDivisions && looks_left_ != 0;
    if (!divides) ++step_.report.undivided;
    const bool meets = divides && find_next_contact(when);
    if (divides) spend(rows_.all().size());
    if (!meets) break;
    travel(when);
    left = left - left * when;
    // The rest of what forces give comes after the contact.
    for (std::uint32_t i = 0; i < state_.material.size(); ++i) gained_.set(i, gained_[i] - gained_[i] * when);
  }
  travel(U(1));
}
/// Changes the way of particles whose velocity was resolved, for the rest of the sub-step.
template <class S> void WorstFirstStep<S>::turn_ways(U left) {
  const auto turn = [&](std::uint32_t slot) {
    if (slot == kNoParticle || state_.velocity[slot] == before_[slot]) return;
    way_.set(slot, detail::travelled<S>(state_.velocity[slot], step_.h) * left);
    before_.set(slot, state_.velocity[slot]);
  };
  for (const Row& row : rows_.all()) {
    turn(row.a);
    turn(row.b);
  }
}
/// Returns the share of the rest of the sub-step until the row's sides touch; 1 if they never do or already touch.
template <class S> Unit<S> WorstFirstStep<S>::time_to(const Row& row) const {
  const Vec3<S> a = step_.now[row.a], way_a = convert<S>(way_[row.a]);
  if (row.kind == ConstraintKind::contact && row.b != kNoParticle)
    return detail::time_to_sphere(step_.now[row.b] - a, convert<S>(way_[row.b]) - way_a, row.radius);
  if (row.other == kNoParticle || row.kind != ConstraintKind::contact) return U(1);
  return detail::time_to_scenery(state_.colliders.all()[row.other], a, way_a, row.radius);
}
/// Finds the time of the first contact that does not touch yet. Returns false if there is none.
template <class S> bool WorstFirstStep<S>::find_next_contact(U& when) {
  bool any = false;
  when = U(1);
  for (const Row& row : rows_.contacts()) {
    if (is_touching(row)) continue;
    const U time = time_to(row);
    if (!(time < when)) continue;
    when = time;
    any = true;
  }
  return any;
}
/// Moves all particles by a share of their way. The rest of the way shrinks.
template <class S> void WorstFirstStep<S>::travel(U share) {
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> way = way_[i], part = way * share;
    step_.move_on(i, part);
    way_.set(i, way - part);
  }
  integration_.place();
}

}  // namespace isostep
