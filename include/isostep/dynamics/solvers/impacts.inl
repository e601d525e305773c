// Bodies of impacts.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/contact_response.hpp"
#include "isostep/dynamics/reduced_mass.hpp"
#include "isostep/dynamics/solvers/impacts.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE Velocity<S> part_of(S part, Velocity<S> v) {
  return saturate_to<Velocity<S>>(product(part, v));
}
/// Applies an impulse to the bodies of a row, where they move.
template <class S>
ISO_INLINE void push(const JointRow<S>& row, MassShare<S> share, Velocity<S> impulse, std::uint32_t a, std::uint32_t b,
                     SolverBodies<S>& bodies) {
  Motion<S> of_a = bodies.velocity[a], of_b = bodies.velocity[b];
  push(row, share, impulse, of_a, of_b);
  if (bodies.moves(a)) bodies.velocity[a] = of_a;
  if (bodies.moves(b)) bodies.velocity[b] = of_b;
}
}  // namespace detail

template <class S> void Impacts<S>::begin(const StepContext<S>& context, const SolverBodies<S>& bodies) {
  bouncing_.clear();
  for (std::uint32_t i = 0; i < context.contacts.size(); ++i) {
    const ContactGeometry<S>& g = context.geometry[i];
    if (!(S(0) < g.material.restitution) || (!bodies.moves(g.row_a) && !bodies.moves(g.row_b))) continue;
    const ContactResponse<S>* const response = response_of(context.responses, i);
    if (response != nullptr && response->is_limited()) continue;
    const S mass_a = bodies.mass[g.row_a].mass, mass_b = bodies.mass[g.row_b].mass;
    const bool fresh = (context.contacts[i].flags & contact_flag::kTouching) == 0;
    if (response == nullptr)
      bouncing_.push_back({i, fresh, mass_share(mass_a, mass_b), reduced_mass(mass_a, mass_b), V(0)});
    else bouncing_.push_back({i, fresh, response->share(mass_a, mass_b), response->reduced(mass_a, mass_b), V(0)});
  }
  if (bouncing_.empty()) return;
  changed_.assign(bodies.mass.size(), 0);
  local_.resize(bodies.mass.size());
  round_ = 0;
}

template <class S> void Impacts<S>::bounce(const StepContext<S>& context, BodyRows<S>& bodies) {
  work_ = 0;
  for (int i = 0; i < kMostRounds && work_ < kMostWork; ++i) {
    find(context, bodies, i == 0);
    if (touches_.empty()) return;
    group(context, bodies.rows());
    stop(context, bodies.rows());
    give_back(context, bodies.rows());
    find_scales();
    apply_scales(context, bodies.rows(), bodies.rate());
    rub(context, bodies.rows());
    for (const TouchRow<S>& touch : touches_) {  // taken for pushes within a sub-step, impacts would change energy
      const ContactGeometry<S>& g = geometry_of(context, touch);
      bodies.accept_turning(context, g.row_a);
      bodies.accept_turning(context, g.row_b);
    }
  }
}

/// Finds the contacts that bounce; after the first round only those on a body that the last round changed.
template <class S> void Impacts<S>::find(const StepContext<S>& context, const BodyRows<S>& bodies, bool first) {
  touches_.clear();
  for (std::uint32_t i = 0; i < bouncing_.size(); ++i) {
    const ContactGeometry<S>& g = context.geometry[bouncing_[i].contact];
    if (first || changed_[g.row_a] == round_ || changed_[g.row_b] == round_) look_at(context, bodies, i);
  }
  ++round_;
}

template <class S>
void Impacts<S>::look_at(const StepContext<S>& context, const BodyRows<S>& bodies, std::uint32_t index) {
  const Bouncing& of = bouncing_[index];
  const ContactGeometry<S>& g = context.geometry[of.contact];
  const SolverBodies<S>& rows = bodies.rows();
  const Vec3<S> n = convert<S>(g.normal);
  const V forced = saturate_to<V>(dot_sum(n, bodies.gain_of(context, g.row_b) - bodies.gain_of(context, g.row_a)));
  // Bodies that nothing presses together do not tremble: only a speed next to nothing does not bounce.
  const bool pressed = !of.fresh || forced < V(0);
  const V least = pressed ? context.restitution_threshold : detail::part_of(S(1.0 / 16), context.restitution_threshold);
  for (std::uint32_t p = 0; p < context.contacts[of.contact].count; ++p) {
    const auto& at = g.points[p];
    const JointRow<S> normal = {n, cross(at.arm_a, n), cross(at.arm_b, n), {}, {}};
    const V speed = detail::along(normal, rows.velocity[g.row_a], rows.velocity[g.row_b]);
    if (!(min(speed, saturating_add(speed, forced)) < -least)) continue;
    TouchRow<S> touch = {};
    touch.bouncing = index;
    touch.point = p;
    touch.normal = normal;
    const V moved = detail::along(normal, rows.displacement[g.row_a], rows.displacement[g.row_b]);
    const V gap = saturating_add(convert<V>(at.separation), moved);
    if (!meets(gap, speed, forced, bodies.rate(), of.fresh ? S(bodies.rate() / context.hz) : S(0), touch)) continue;
    if (!(touch.met < -least)) continue;
    const SolverMass<S> a = seen(context, rows, of, true), b = seen(context, rows, of, false);
    touch.share = of.share;
    touch.normal.turn_a = (a.kappa * touch.normal.angular_a) * of.share.a;
    touch.normal.turn_b = (b.kappa * touch.normal.angular_b) * of.share.b;
    touch.mass = detail::mass_of(detail::coupling_of(touch.normal, touch.normal, of.share.a + of.share.b));
    touches_.push_back(touch);
  }
}

/// Returns true if the gap [m] closes within the sub-step, or closed up to `before` sub-steps ago, and finds when: by
/// the mean speed until then, which forces change at a constant rate. A touch that the solver's rows would stop must
/// bounce, or it loses all of its speed: they take the speed at the sub-step's end for all of it, and round.
template <class S> bool Impacts<S>::meets(V gap, V speed, V forced, std::int32_t rate, S before, TouchRow<S>& touch) {
  const V widest = divide_to<V>(S(64), S(rate));  // nothing farther apart meets within the sub-step
  const V way = saturate_to<V>(product(S(rate), clamp(gap, -widest, widest)));  // [m/s] to touch within a sub-step
  const V fastest = min(speed, saturating_add(speed, forced));
  if (detail::part_of(S(-1 - 1.0 / 64), fastest) < way) return false;
  V mean = saturating_add(speed, detail::part_of(S(0.5), forced));
  for (int i = 0; i < 3; ++i) {  // forces add little to what is fast enough to bounce
    if (!(mean < V(0))) return false;
    if (S(0) < before && way < detail::part_of(before, mean)) touch.time = -before;
    else if (-mean - mean < way) touch.time = S(2);  // it slows down
    else touch.time = way < V(0) && before == S(0) ? S(0) : divide_to<S>(way, -mean);
    touch.forced = detail::part_of(touch.time, forced);
    touch.met = saturating_add(speed, touch.forced);
    mean = saturating_add(speed, detail::part_of(S(0.5), touch.forced));
  }
  return true;
}

/// Returns the body as the contact sees it, with its current inertia: one sub-steps old would change the energy.
template <class S>
SolverMass<S> Impacts<S>::seen(const StepContext<S>& context, const SolverBodies<S>& bodies, const Bouncing& of,
                               bool is_a) const {
  const ContactGeometry<S>& g = context.geometry[of.contact];
  const std::uint32_t row = is_a ? g.row_a : g.row_b;
  SolverMass<S> body = bodies.mass[row];
  if (bodies.moves(row) && (context.properties[row - 1].flags & body_flag::kSpins) != 0) {
    const BodyProperties<S>& of_row = context.properties[row - 1];
    body.kappa = detail::world_kappa(of_row, detail::world_axes(context.states[row - 1].orientation, of_row));
  }
  const ContactResponse<S>* const response = response_of(context.responses, of.contact);
  if (response == nullptr) return body;
  return is_a ? response->seen_a(body) : response->seen_b(body);
}

/// Forms groups: touches that share moving bodies, directly or through others, are in one group.
template <class S> void Impacts<S>::group(const StepContext<S>& context, const SolverBodies<S>& bodies) {
  std::uint32_t locals = 0;
  const auto number = [&](std::uint32_t row) {
    if (changed_[row] != round_) local_[row] = locals++;
    changed_[row] = round_;
    return local_[row];
  };
  for (TouchRow<S>& touch : touches_) {
    const ContactGeometry<S>& g = geometry_of(context, touch);
    if (bodies.moves(g.row_a)) touch.group = number(g.row_a);
    if (bodies.moves(g.row_b)) touch.group = number(g.row_b);
  }
  sets_.begin(locals);
  for (const TouchRow<S>& touch : touches_) {
    const ContactGeometry<S>& g = geometry_of(context, touch);
    if (bodies.moves(g.row_a) && bodies.moves(g.row_b)) sets_.join(local_[g.row_a], local_[g.row_b]);
  }
  groups_.assign(locals, Group{});
  for (TouchRow<S>& touch : touches_) {
    touch.group = sets_.find(touch.group);
    Group& group = groups_[touch.group];
    group.fastest = max(group.fastest, -touch.met);
    group.heaviest = max(group.heaviest, bouncing_[touch.bouncing].reduced);
    ++group.touches;
  }
}

template <class S>
Velocity<S> Impacts<S>::speed_of(const TouchRow<S>& touch, const ContactGeometry<S>& g,
                                 const SolverBodies<S>& bodies) const {
  return saturating_add(detail::along(touch.normal, bodies.velocity[g.row_a], bodies.velocity[g.row_b]), touch.forced);
}

/// Finds impulses >= 0 after which no touch closes, and which are 0 at touches that open. Every group makes as many
/// passes as it needs: other islands do not change it.
template <class S> void Impacts<S>::stop(const StepContext<S>& context, SolverBodies<S>& bodies) {
  const auto count = static_cast<std::uint32_t>(touches_.size());
  for (int pass = 0; pass < kMostPasses && work_ < kMostWork; ++pass) {
    for (std::uint32_t k = 0; k < count; ++k) {
      TouchRow<S>& touch = touches_[pass % 2 == 0 ? k : count - 1 - k];
      Group& group = groups_[touch.group];
      if (group.is_stopped) continue;
      ++work_;
      const ContactGeometry<S>& g = geometry_of(context, touch);
      const V next =
          max(saturating_subtract(touch.impulse, detail::part_of(touch.mass, speed_of(touch, g, bodies))), V(0));
      const V change = next - touch.impulse;
      touch.impulse = next;
      detail::push(touch.normal, touch.share, change, g.row_a, g.row_b, bodies);
      group.change = max(group.change, abs(change));
    }
    if (end_pass()) return;
  }
}
/// Returns true if all groups are stopped: one touch after one pass, several once impulses hardly change.
template <class S> bool Impacts<S>::end_pass() {
  bool all = true;
  for (Group& group : groups_) {
    const V tolerance = detail::part_of(S(0x1p-16), group.fastest);
    group.is_stopped = group.is_stopped || group.touches < 2 || !(tolerance < group.change);
    group.change = V(0);
    all = all && group.is_stopped;
  }
  return all;
}

/// Gives the stopping impulses e times again, and sums the energy that this adds to each group.
template <class S> void Impacts<S>::give_back(const StepContext<S>& context, SolverBodies<S>& bodies) {
  for (TouchRow<S>& touch : touches_) {
    const ContactGeometry<S>& g = geometry_of(context, touch);
    Group& group = groups_[touch.group];
    touch.weight = divide_to<S>(bouncing_[touch.bouncing].reduced, group.heaviest);
    const S met = divide_to<S>(touch.met, group.fastest);
    const auto work_of = [&](V impulse)
                             ISO_INLINE_LAMBDA { return touch.weight * (divide_to<S>(impulse, group.fastest) * met); };
    group.stopping = saturating_add(group.stopping, work_of(touch.impulse));
    const V more = detail::part_of(g.material.restitution, touch.impulse);
    touch.impulse = saturating_add(touch.impulse, more);
    group.work = saturating_add(group.work, work_of(touch.impulse));
    detail::push(touch.normal, touch.share, more, g.row_a, g.row_b, bodies);
  }
  for (const TouchRow<S>& touch : touches_) {
    Group& group = groups_[touch.group];
    const V change = saturating_subtract(speed_of(touch, geometry_of(context, touch), bodies), touch.met);
    const S along = divide_to<S>(touch.impulse, group.fastest) * divide_to<S>(change, group.fastest);
    group.curve = saturating_add(group.curve, touch.weight * along);
  }
}

/// The energy of a group's impulses at a scale s is work s + curve s^2 / 2, which is least at -work / curve.
template <class S> void Impacts<S>::find_scales() {
  for (Group& group : groups_) {
    if (group.touches < 2) continue;  // exact but for rounding
    group.scale = S(0);
    if (!(group.work < S(0)) || !(group.stopping < S(0)) || !(S(0) < group.curve)) continue;
    const S given = clamp(divide_to<S>(group.work, group.stopping), S(1), S(2));  // 1 + e
    const S least = min(divide_to<S>(min(-group.work, group.curve), group.curve), S(1));
    group.scale = given * least;
  }
}

template <class S>
void Impacts<S>::apply_scales(const StepContext<S>& context, SolverBodies<S>& bodies, std::int32_t rate) {
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  for (TouchRow<S>& touch : touches_) {
    const ContactGeometry<S>& g = geometry_of(context, touch);
    const S scale = groups_[touch.group].scale;
    if (!(scale == S(1))) {
      const V change = detail::part_of(scale - S(1), touch.impulse);
      touch.impulse = saturating_add(touch.impulse, change);
      detail::push(touch.normal, touch.share, change, g.row_a, g.row_b, bodies);
    }
    V& given = bouncing_[touch.bouncing].given;
    given = saturating_add(given, touch.impulse);
    // Bodies begin the sub-step where they come from by their new velocities: back along the change.
    const V shift = round_to<V>(product(detail::part_of(-touch.time, touch.impulse), h));
    const auto move = [&](std::uint32_t row, S share, V by) {
      if (!bodies.moves(row)) return;
      Vec3<V>& d = bodies.displacement[row].linear;
      d = detail::pushed(d, touch.normal.linear, detail::part_of(share, by), detail::passing_velocity<S>());
    };
    move(g.row_a, touch.share.a, -shift);
    move(g.row_b, touch.share.b, shift);
  }
}

/// Applies friction, within the cone of the impulse that each point bore.
template <class S> void Impacts<S>::rub(const StepContext<S>& context, SolverBodies<S>& bodies) {
  for (const TouchRow<S>& touch : touches_) {
    const ContactGeometry<S>& g = geometry_of(context, touch);
    if (!(S(0) < g.material.friction) || !(V(0) < touch.impulse)) continue;
    const Bouncing& of = bouncing_[touch.bouncing];
    const SolverMass<S> mass_a = seen(context, bodies, of, true), mass_b = seen(context, bodies, of, false);
    const Tangents<Unit<S>> basis = friction_tangents(g);
    TangentPair<S> pair = {};
    pair.ratio = g.ratio;
    const auto& at = g.points[touch.point];
    const auto across = [&](Vec3<Unit<S>> d) {
      const Vec3<S> t = convert<S>(d);
      return detail::weighed_row(t, cross(at.arm_a, t), cross(at.arm_b, t), mass_a, mass_b, of.share);
    };
    pair.rows[0] = across(basis.t);
    pair.rows[1] = across(basis.u);
    detail::invert_pair(pair, of.share.a + of.share.b);
    pair.surface[0] = saturate_to<V>(dot_sum(g.material.surface_velocity, basis.t));
    pair.surface[1] = saturate_to<V>(dot_sum(g.material.surface_velocity, basis.u));
    const V limit = saturate_to<V>(product(g.material.friction, touch.impulse));
    Motion a = bodies.velocity[g.row_a], b = bodies.velocity[g.row_b];
    const auto change = detail::resting_change(pair, limit, a, b);
    detail::push(pair.rows[0], of.share, change.x, g.row_a, g.row_b, bodies);
    detail::push(pair.rows[1], of.share, change.y, g.row_a, g.row_b, bodies);
  }
}

template <class S> void Impacts<S>::store(const StepContext<S>& context) const {
  for (const Bouncing& of : bouncing_) {
    if (!(V(0) < of.given)) continue;
    context.contacts[of.contact].flags |= contact_flag::kTouching;
    context.step_impulses[of.contact] = saturating_add(context.step_impulses[of.contact], of.given);
  }
}

}  // namespace isostep
