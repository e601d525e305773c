// Bodies of the worst-first resolver.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/solvers/worst_first.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

// ---- what a row sees

template <class S> ISO_INLINE Vec3<Velocity<S>> WorstFirst<S>::velocity_of_b(const Row& row, Sides sides) const {
  if (sides.b != kNoParticle) return points_[sides.b].velocity;
  return row.kind == ConstraintKind::contact ? row.surface_velocity : Vec3<V>::zero();
}

template <class S> ISO_INLINE Velocity<S> WorstFirst<S>::separating_speed(const Row& row, Sides sides) const {
  return saturate_to<V>(dot_sum(row.normal, velocity_of_b(row, sides)) -
                        dot_sum(row.normal, points_[sides.a].velocity));
}

template <class S> ISO_INLINE Velocity<S> WorstFirst<S>::gained_speed(const Row& row, Sides sides) const {
  const Vec3<V> b = sides.b != kNoParticle ? points_[sides.b].gained : Vec3<V>::zero();
  return saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, points_[sides.a].gained));
}

/// Computes C from the two displacements each time, so that the roundings of moves do not pile up.
template <class S> ISO_INLINE Velocity<S> WorstFirst<S>::gap(const Row& row, Sides sides) const {
  // Half the range of Velocity<S> leaves the other half for displacements; what is farther off cannot meet in a step.
  const S limit = convert<S>(highest<V>()) * S(0.5);
  const V start = convert<V>(clamp(row.separation, -limit, limit));
  const Vec3<V> b = sides.b != kNoParticle ? points_[sides.b].displacement : Vec3<V>::zero();
  return saturate_to<V>(widen<SumOf<Unit<S>, V>>(start) + dot_sum(row.normal, b) -
                        dot_sum(row.normal, points_[sides.a].displacement));
}

template <class S> ISO_INLINE Velocity<S> WorstFirst<S>::fastest_of(const Row& row, Sides sides) const {
  return max(max_abs(points_[sides.a].velocity), max_abs(velocity_of_b(row, sides)));
}

/// Returns the change of friction that would stop the sliding, kept within the cone.
template <class S>
ISO_INLINE Vec3<Velocity<S>> WorstFirst<S>::friction_change(const Row& row, Sides sides, V speed) const {
  const Vec3<V> relative = velocity_of_b(row, sides) - points_[sides.a].velocity;
  const Vec3<V> slip = saturating_subtract(relative, row.normal * speed);
  // It is held, so that it has a length in the format.
  const Vec3<V> wanted = held_within(saturating_subtract(row.friction_impulse, slip), passing_speed<S>());
  const V limit = saturate_to<V>(product(row.friction, row.impulse));
  const Heading<V> way = heading_of(wanted);
  if (!(limit < way.length)) return wanted - row.friction_impulse;
  return way.direction * limit - row.friction_impulse;
}

template <class S> void WorstFirst<S>::look(const Row& row, std::uint32_t index) {
  ++looks_;
  Urgency& urgency = urgency_[index];
  urgency = {Need::nothing, V(0)};
  if (row.share_a == Unit<S>(0) && row.share_b == Unit<S>(0)) return;  // nothing can be done for it
  const Sides sides = sides_[index];
  const bool rod = row.kind == ConstraintKind::rod;
  const V tolerance = convert<V>(resolution<S>()) * V(4);
  const V separation = rod ? -abs(gap(row, sides)) : gap(row, sides);
  if (rod || separation <= tolerance) touched_[index] = 1;
  if (touched_[index] == 0) return;
  const V speed = separating_speed(row, sides);
  V motion = rod ? -abs(speed) : speed;
  if (row.kind == ConstraintKind::contact && row.friction > S(0) && row.impulse > V(0)) {
    motion = min(motion, -max_abs(friction_change(row, sides, speed)));
  }
  if (motion < -speed_tolerance<S>(fastest_of(row, sides))) {
    urgency = {Need::motion, motion};
  } else if (separation < -tolerance) {
    urgency = {Need::projection, separation};
  }
}

// ---- what is done to it

template <class S>
ISO_INLINE void WorstFirst<S>::push(const Row& row, Sides sides, Vec3<V> change, Vec3<V> Point::*of, V most) {
  Vec3<V>& a = points_[sides.a].*of;
  a = held_within(saturating_subtract(a, change * row.share_a), most);
  if (sides.b == kNoParticle) return;
  Vec3<V>& b = points_[sides.b].*of;
  b = held_within(saturating_add(b, change * row.share_b), most);
}

/// Gives the impulse to both sides: a surface that was touched from outside reacts too.
template <class S> ISO_INLINE void WorstFirst<S>::hit(Row& row, Sides sides, Vec3<V> change) {
  const V most = passing_speed<S>();
  push(row, sides, change, &Point::velocity, most);
  if (sides.b != kNoParticle) return;
  row.surface_velocity = held_within(saturating_add(row.surface_velocity, change * row.share_b), most);
  row.total = saturating_add(row.total, change);
}

/// `gained` <= 0 presses on while they part, and on the way out of an overlap.
template <class S>
ISO_INLINE Velocity<S> WorstFirst<S>::bounced_speed(const Row& row, V former, V gained, V separation) const {
  const V overlap = min(saturate_to<V>(product(separation, rate_)), V(0));
  const V came = lags_ ? saturating_subtract(former, gained * V(0.5)) : former;
  const V met = worked_speed<S>(came, -gained, overlap);
  return max(round_to<V>(product(row.restitution, met)) + gained, V(0));
}

/// Applies velocity, then friction within the cone that this opens, then position (pp. 111, 140, 115). Moves are
/// applied to the particles at once and never kept, so none can be applied twice.
template <class S> void WorstFirst<S>::apply(Row& row, std::uint32_t index) {
  const Sides sides = sides_[index];
  const bool rod = row.kind == ConstraintKind::rod;
  const V speed = separating_speed(row, sides);
  if (rod || speed < V(0)) {
    const V gained = rod ? gained_speed(row, sides) : min(gained_speed(row, sides), V(0));
    const V former = max(saturating_subtract(speed, gained), -highest<V>());
    const V bounce = rod || former >= -kLeastBounce<S> ? V(0) : bounced_speed(row, -former, gained, gap(row, sides));
    const V impulse = saturating_subtract(bounce, speed);
    hit(row, sides, row.normal * impulse);
    push(row, sides, row.normal * (rod ? -gained : -max(gained, speed)), &Point::gained, highest<V>());
    row.impulse = saturating_add(row.impulse, impulse);
    row.approach = min(row.approach, speed);
  }
  if (row.kind == ConstraintKind::contact && row.friction > S(0) && row.impulse > V(0)) {
    const Vec3<V> change = friction_change(row, sides, separating_speed(row, sides));
    hit(row, sides, change);
    row.friction_impulse += change;
  }
  const V separation = gap(row, sides);
  if (rod || separation < V(0)) {
    push(row, sides, row.normal * -separation, &Point::displacement, passing_distance<S>());
  }
}

// ---- the most urgent row

template <class S> void WorstFirst<S>::look_at_neighbours(const Row* rows, std::uint32_t index, std::uint32_t point) {
  if (point == kNoParticle) return;
  for (std::uint32_t k = first_[point]; k < first_[point + 1]; ++k) {
    const std::uint32_t other = neighbours_[k];
    if (other == index) continue;
    look(rows[other], other);
    worst_.replay(other, before());
  }
}

template <class S>
std::uint32_t WorstFirst<S>::resolve(ParticleConstraint<S>* rows, std::uint32_t count, Axes<V>& velocity,
                                     Axes<V>& displacement, const Axes<V>& gained, const ResolverTerms<S>& terms) {
  rate_ = terms.rate;
  lags_ = terms.lags;
  iterations_ = 0;
  looks_ = 0;
  if (count == 0) return 0;
  gather(rows, count, velocity, displacement, gained);
  for (std::uint32_t i = 0; i < count; ++i) {
    rows[i].impulse = V(0);
    rows[i].friction_impulse = Vec3<V>::zero();
    touched_[i] = 0;
  }
  const std::uint32_t unsettled = terms.looks < count ? pass_over(rows, count) : resolve_worst(rows, count, terms);
  scatter(velocity, displacement);
  return unsettled;
}

template <class S>
std::uint32_t WorstFirst<S>::resolve_worst(Row* rows, std::uint32_t count, const ResolverTerms<S>& terms) {
  list_neighbours(rows, count);
  for (std::uint32_t i = 0; i < count; ++i) look(rows[i], i);
  worst_.plant(count, before());
  share_out(rows, count);
  const std::optional<std::uint32_t> shared = terms.iterations;
  std::uint32_t unsettled = 0;
  while (!shared || iterations_ < *shared) {
    const std::uint32_t worst = worst_.first();
    if (urgency_[worst].need == Need::nothing) break;
    if (terms.looks <= looks_) return pass_over(rows, count);
    ++iterations_;
    const std::uint64_t before_it = looks_;
    apply(rows[worst], worst);
    look(rows[worst], worst);
    worst_.replay(worst, before());
    look_at_neighbours(rows, worst, sides_[worst].a);
    look_at_neighbours(rows, worst, sides_[worst].b);
    IslandBudgets::Budget& budget = budgets_.budget_of(worst);
    budget.looks -= min(looks_ - before_it, budget.looks);
    --budget.iterations;
    const bool spent = !shared && budget.iterations == 0;
    if (spent || budget.looks == 0) unsettled += leave_island(worst);
  }
  for (std::uint32_t i = 0; i < count; ++i) unsettled += urgency_[i].need != Need::nothing;
  return unsettled;
}

/// Islands are found anew in each call, though a step's calls have the same: of 19800 rows that takes 0.08 ms, a fifth
/// of a call that finds nothing to do and nothing beside one that does. The first look at each row is paid.
template <class S> void WorstFirst<S>::share_out(const Row* rows, std::uint32_t count) {
  const auto ends_of = [&](std::uint32_t i) ISO_INLINE_LAMBDA -> IslandBudgets::Ends {
    const Sides sides = sides_[i];
    const bool moves_a = rows[i].share_a != Unit<S>(0), moves_b = rows[i].share_b != Unit<S>(0);
    return {moves_a ? sides.a : IslandBudgets::kNobody, moves_b ? sides.b : IslandBudgets::kNobody};
  };
  budgets_.find(static_cast<std::uint32_t>(points_.size()), count, ends_of);
  budgets_.fill([](IslandBudgets::Budget& budget) ISO_INLINE_LAMBDA {
    budget.iterations = default_iterations(budget.rows);
    budget.looks = most_looks(budget.rows) - budget.rows;
  });
}
/// Ends an island whose budget is spent: none of its rows is resolved again. Returns how many stay unsettled.
template <class S> std::uint32_t WorstFirst<S>::leave_island(std::uint32_t row) {
  std::uint32_t unsettled = 0;
  for (std::uint32_t i = budgets_.budget_of(row).first_row; i != IslandBudgets::kNobody; i = budgets_.next_of(i)) {
    if (urgency_[i].need == Need::nothing) continue;
    ++unsettled;
    urgency_[i] = {Need::nothing, V(0)};
    worst_.replay(i, before());
  }
  return unsettled;
}

/// Resolves every row once, in order. Returns how many had something to do.
template <class S> std::uint32_t WorstFirst<S>::pass_over(Row* rows, std::uint32_t count) {
  std::uint32_t unsettled = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    look(rows[i], i);
    if (urgency_[i].need == Need::nothing) continue;
    apply(rows[i], i);
    ++unsettled;
  }
  return unsettled;
}

// ---- particles in and out

template <class S>
std::uint32_t WorstFirst<S>::point_of(std::uint32_t slot, const Axes<V>& velocity, const Axes<V>& displacement,
                                      const Axes<V>& gained) {
  if (slot == kNoParticle) return kNoParticle;
  if (point_of_[slot] == kNoParticle) {
    point_of_[slot] = static_cast<std::uint32_t>(slots_.size());
    slots_.push_back(slot);
    points_.push_back({velocity[slot], displacement[slot], gained[slot]});
  }
  return point_of_[slot];
}

template <class S>
void WorstFirst<S>::gather(const Row* rows, std::uint32_t count, const Axes<V>& velocity, const Axes<V>& displacement,
                           const Axes<V>& gained) {
  if (point_of_.size() < velocity.size()) point_of_.resize(velocity.size(), kNoParticle);
  if (sides_.size() < count) {
    sides_.resize(count);
    touched_.resize(count);
    urgency_.resize(count);
  }
  points_.clear();
  slots_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = point_of(rows[i].a, velocity, displacement, gained);
    sides_[i] = {a, point_of(rows[i].b, velocity, displacement, gained)};
  }
}

/// Lists only rows that a resolved one can change: a million contacts with one pinned particle are no neighbours.
template <class S> void WorstFirst<S>::list_neighbours(const Row* rows, std::uint32_t count) {
  const std::size_t points = points_.size();
  first_.assign(points + 2, 0);  // counted two places on: filling leaves each list's start where it is looked for
  const auto each_movable_side = [&](auto&& visit) ISO_INLINE_LAMBDA {
    for (std::uint32_t i = 0; i < count; ++i) {
      const Sides sides = sides_[i];
      if (rows[i].share_a != Unit<S>(0)) visit(sides.a, i);
      if (sides.b != kNoParticle && rows[i].share_b != Unit<S>(0)) visit(sides.b, i);
    }
  };
  each_movable_side([&](std::uint32_t point, std::uint32_t) ISO_INLINE_LAMBDA { ++first_[point + 2]; });
  for (std::size_t p = 2; p < points + 2; ++p) first_[p] += first_[p - 1];
  if (neighbours_.size() < first_[points + 1]) neighbours_.resize(first_[points + 1]);
  each_movable_side([&](std::uint32_t point, std::uint32_t i)
                        ISO_INLINE_LAMBDA { neighbours_[first_[point + 1]++] = i; });
}

template <class S> void WorstFirst<S>::scatter(Axes<V>& velocity, Axes<V>& displacement) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::uint32_t slot = slots_[p];
    velocity.set(slot, points_[p].velocity);
    displacement.set(slot, points_[p].displacement);
    point_of_[slot] = kNoParticle;
  }
}

}  // namespace isostep
