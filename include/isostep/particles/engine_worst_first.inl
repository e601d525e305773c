// ParticleEngine: the book's two ways. Worst-first resolution between the velocities and the positions of a sub-step,
// and time division, which ends a sub-step's first part where the next contact comes about.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/engine_integrate.inl"

namespace isostep {

/// Contacts that one sub-step is divided by, at most: two particles between two walls that close in on them meet
/// without end.
inline constexpr std::uint32_t kMostDivisions = 64;

/// The velocities of a sub-step without its way, which is kept apart: resolution stands between the two, so that
/// gravity's way along a slope is friction's to undo.
template <class S> void ParticleEngine<S>::integrate_velocities() {
  scratch_.before = state_.velocity;
  scratch_.first_displacement = scratch_.displacement;
  integrate();
  note_gained();
  scratch_.way.resize(state_.material.size());
  for (std::uint32_t i = 0; i < state_.material.size(); ++i)
    scratch_.way.set(i, saturating_subtract(scratch_.displacement[i], scratch_.first_displacement[i]));
  scratch_.displacement = scratch_.first_displacement;
  renew_positions();
}
/// What forces added to the velocities since `before`, which are `before` from now on.
template <class S> void ParticleEngine<S>::note_gained() {
  scratch_.gained.resize(state_.material.size());
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const bool moves = InverseMass<S>(0) < state_.inverse_mass[i];
    scratch_.gained.set(i, moves ? saturating_subtract(state_.velocity[i], scratch_.before[i]) : Vec3<V>::zero());
  }
  scratch_.before = state_.velocity;
}

/// Rows as WorstFirst has them: separations as the step began. What rounding alone keeps apart touches.
template <class S> void ParticleEngine<S>::place_rows() {
  look();
  const Axes<V>& d = scratch_.displacement;
  for (ParticleConstraint<S>& row : rows_) {
    row.shift = max(-saturate_to<V>(product(row.separation, rate_)), V(0));
    if (is_touching(row)) row.separation = min(row.separation, S(0));
    const auto of_b = dot_sum(row.normal, row.b == kNoParticle ? Vec3<V>::zero() : d[row.b]);
    row.separation -= convert<S>(saturate_to<V>(of_b - dot_sum(row.normal, d[row.a])));
  }
}
template <class S> bool ParticleEngine<S>::is_touching(const ParticleConstraint<S>& row) const {
  const S tolerance = spacing_at(max_abs(scratch_.now[row.a])) * S(16);
  return row.kind == ConstraintKind::contact && row.separation <= tolerance;
}
/// Looks at rows, of those that a step has.
template <class S> void ParticleEngine<S>::spend(std::uint64_t looks) {
  if (looks_left_ <= looks && looks != 0) ++report_.spent;
  looks_left_ -= min(looks, looks_left_);
}
template <class S> void ParticleEngine<S>::resolve_rows() {
  const auto count = static_cast<std::uint32_t>(rows_.size());
  const std::uint32_t asked = state_.settings.iterations;
  ResolverTerms<S> terms = {arrives() ? rate_ + rate_ : rate_, !arrives(), std::nullopt, looks_left_};
  if (asked != 0) terms.iterations = asked;
  report_.unresolved +=
      worst_first_.resolve(rows_.data(), count, state_.velocity, scratch_.displacement, scratch_.gained, terms);
  spend(worst_first_.looks());
  for (ParticleConstraint<S>& row : rows_) row.impulse_seen = max(row.impulse_seen, row.impulse);
}

/// What came back out of an overlap has its speed from where it was. Where the forces that it was pushed against are
/// stronger at the surface than they were there, the difference is to be paid too.
template <class S> void ParticleEngine<S>::pay_for_ways() {
  const auto pays = [](const ParticleConstraint<S>& row) {
    return V(0) < row.shift && S(0) < row.restitution && V(0) < row.impulse && row.kind != ConstraintKind::rod;
  };
  bool any = false;
  for (const ParticleConstraint<S>& row : rows_) any = any || pays(row);
  if (!any || !has_forces()) return;
  renew_positions();
  accelerate();
  pull_stiff_springs();
  for (ParticleConstraint<S>& row : rows_) {
    const V speed = separating_speed(row);
    if (!pays(row) || !(V(0) < speed)) continue;
    const Vec3<V> of_b = row.b == kNoParticle ? row.surface_gain : scratch_.gained[row.b];
    V paid = saturate_to<V>(dot_sum(row.normal, scratch_.gained[row.a]) - dot_sum(row.normal, of_b));
    if (arrives()) paid = saturating_add(paid, paid);
    const V more = saturating_subtract(closing_gain(row), max(paid, V(0)));
    if (V(0) < more) give(row, row.normal * saturating_subtract(worked_speed<S>(speed, -more, row.shift), speed));
  }
}

template <class S> void ParticleEngine<S>::resolve_substep() {
  integrate_velocities();
  if (state_.settings.stepping == Stepping::time_division) {
    divide_way();
  } else {
    place_rows();
    resolve_rows();
    pay_for_ways();
    for (std::uint32_t i = 0; i < state_.material.size(); ++i) move_on(i, scratch_.way[i]);
    move_by_constraints();
  }
  if (!arrives()) return;
  // What presses with the other half of the forces must not leave with it.
  scratch_.before = state_.velocity;
  arrive();
  note_gained();
  renew_positions();
  place_rows();
  resolve_rows();
  pay_for_ways();
}

// ---- time division

namespace detail {
/// When a point that moves from p by `way` comes within `radius` of the origin, as a share of the way; 1 for never.
/// Lengths along and across the way, so that nothing is squared that might not fit.
template <class S> ISO_INLINE Unit<S> time_to_sphere(Vec3<S> p, Vec3<S> way, S radius) {
  using U = Unit<S>;
  const Direction<S> along = direction_of(way.x, way.y, way.z);
  const Vec3<U> u = {along.x, along.y, along.z};
  const S ahead = -dot(p, u);  // to the nearest point
  if (along.length == S(0) || ahead <= S(0)) return U(1);
  const Vec3<S> off = p + u * ahead;
  const S miss = length(off);
  if (!(miss < radius)) return U(1);
  const S before = ahead - sqrt(radius - miss) * sqrt(radius + miss);
  if (before <= S(0)) return U(0);
  return before < along.length ? divide_to<U>(before, along.length) : U(1);
}
template <class S> ISO_INLINE Unit<S> time_to_plane(const Collider<S>& plane, Vec3<S> p, Vec3<S> way, S radius) {
  using U = Unit<S>;
  const S gap = dot(p, plane.normal) - plane.offset - radius, closing = -dot(way, plane.normal);
  if (!(gap < closing)) return U(1);
  return S(0) < gap ? divide_to<U>(gap, closing) : U(0);
}
/// A line is a cylinder between two spheres.
template <class S> ISO_INLINE Unit<S> time_to_line(const Collider<S>& line, Vec3<S> p, Vec3<S> way, S radius) {
  using U = Unit<S>;
  const S reach = line.radius + radius;
  U first = min(time_to_sphere(p - line.start, way, reach), time_to_sphere(p - line.end, way, reach));
  const Vec3<S> span = line.end - line.start;
  const Direction<S> axis = direction_of(span.x, span.y, span.z);
  const Vec3<U> u = {axis.x, axis.y, axis.z};
  const Vec3<S> d = p - line.start;
  const S at = dot(d, u), goes = dot(way, u);
  const U when = time_to_sphere(d - u * at, way - u * goes, reach);
  const S there = at + goes * when;
  return S(0) <= there && there <= axis.length ? min(first, when) : first;
}
}  // namespace detail

/// Of what is left of the sub-step, until the row's sides touch; 1: they do not, or they touch already.
template <class S> Unit<S> ParticleEngine<S>::time_to(const ParticleConstraint<S>& row) const {
  const Vec3<S> a = scratch_.now[row.a], way_a = convert<S>(scratch_.way[row.a]);
  if (row.kind == ConstraintKind::contact && row.b != kNoParticle) {
    return detail::time_to_sphere(scratch_.now[row.b] - a, convert<S>(scratch_.way[row.b]) - way_a, row.radius);
  }
  if (row.other == kNoParticle || row.kind != ConstraintKind::contact) return U(1);
  const Collider<S>& collider = state_.colliders.all()[row.other];
  return collider.type == ColliderType::plane ? detail::time_to_plane(collider, a, way_a, row.radius)
                                              : detail::time_to_line(collider, a, way_a, row.radius);
}
/// The first row to touch that does not yet, the lowest index of equals; kNoParticle for none.
template <class S> std::uint32_t ParticleEngine<S>::next_contact(Unit<S>& when) const {
  std::uint32_t next = kNoParticle;
  when = U(1);
  for (std::uint32_t i = first_contact_; i < first_touch_; ++i) {
    if (is_touching(rows_[i])) continue;
    const U time = time_to(rows_[i]);
    if (time < when) {
      when = time;
      next = i;
    }
  }
  return next;
}
/// All particles a share of their way on; what is left of it shrinks.
template <class S> void ParticleEngine<S>::travel(Unit<S> share) {
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> way = scratch_.way[i], part = way * share;
    move_on(i, part);
    scratch_.way.set(i, way - part);
  }
  renew_positions();
}

/// What was resolved goes another way for the rest of the sub-step.
template <class S> void ParticleEngine<S>::turn_ways(Unit<S> left) {
  const auto turn = [&](std::uint32_t slot) {
    if (slot == kNoParticle || state_.velocity[slot] == scratch_.before[slot]) return;
    scratch_.way.set(slot, detail::travelled<S>(state_.velocity[slot], h_) * left);
    scratch_.before.set(slot, state_.velocity[slot]);
  };
  for (const ParticleConstraint<S>& row : rows_) {
    turn(row.a);
    turn(row.b);
  }
}

/// Source:  Millington, ch. 7.4.2.  Differs: between contacts particles move in straight lines, the sub-step's way.
///          What touches already is resolved as the sub-step begins; cables and rods are, whenever anything is.
template <class S> void ParticleEngine<S>::divide_way() {
  U left = U(1);  // [1] of the sub-step
  for (std::uint32_t division = 0;; ++division) {
    place_rows();
    resolve_rows();
    pay_for_ways();
    turn_ways(left);
    renew_positions();
    look();
    U when;
    const bool divides = division < kMostDivisions && looks_left_ != 0;
    if (!divides) ++report_.undivided;
    const std::uint32_t next = divides ? next_contact(when) : kNoParticle;
    if (divides) spend(rows_.size());
    if (next == kNoParticle) break;
    travel(when);
    left = left - left * when;
    // The rest of what forces give comes after the contact.
    for (std::uint32_t i = 0; i < state_.material.size(); ++i)
      scratch_.gained.set(i, scratch_.gained[i] - scratch_.gained[i] * when);
  }
  travel(U(1));
}

}  // namespace isostep
