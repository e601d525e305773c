// Bodies of worst_first.hpp: rows, who shares bodies with whom, and the passes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/worst_first.hpp"
#include "isostep/book/worst_first_position.inl"
#include "isostep/book/worst_first_take_back.inl"
#include "isostep/book/worst_first_velocity.inl"
#include "isostep/dynamics/solvers/body_rows.inl"

namespace isostep {

template <class S, class Queue> void WorstFirstResolver<S, Queue>::colour_constraints(const StepContext<S>& context) {
  any_followed_ =
      bodies_.gather(context, integration_rate(SolverName::worst_first, context.hz, context.substeps), true);
  joints_.prepare_all(context, bodies_.rows());
  impacts_.begin(context, bodies_.rows());
  const SolverBodies<S>& bodies = bodies_.rows();
  const auto mover = [&](std::uint32_t row) { return bodies.moves(row) ? row : 0u; };
  points_.clear();
  rolling_.clear();
  held_.clear();
  ends_.clear();
  for (std::uint32_t i = 0; i < context.contacts.size(); ++i) {
    const ContactGeometry<S>& g = context.geometry[i];
    const Ends ends = {mover(g.row_a), mover(g.row_b)};
    if (ends.a == 0 && ends.b == 0) continue;
    for (std::uint32_t p = 0; p < context.contacts[i].count; ++p) {
      add_point(context, i, p);
      ends_.push_back(ends);
    }
  }
  for (std::uint32_t j = 0; j < joints_.size(); ++j) {
    if (!joints_[j].holds) continue;
    held_.push_back(j);
    ends_.push_back({mover(joints_[j].row_a), mover(joints_[j].row_b)});
  }
  urgency_.resize(ends_.size());
  list_neighbours();
  const auto moved = [](std::uint32_t body) ISO_INLINE_LAMBDA { return body == 0 ? IslandBudgets::kNobody : body; };
  budgets_.find(static_cast<std::uint32_t>(bodies.mass.size()), static_cast<std::uint32_t>(ends_.size()),
                [&](std::uint32_t row) ISO_INLINE_LAMBDA -> IslandBudgets::Ends {
                  return {moved(ends_[row].a), moved(ends_[row].b)};
                });
}

template <class S, class Queue>
void WorstFirstResolver<S, Queue>::add_point(const StepContext<S>& context, std::uint32_t contact,
                                             std::uint32_t point) {
  const ContactGeometry<S>& g = context.geometry[contact];
  Point row = {};
  row.contact = contact;
  row.a = g.row_a;
  row.b = g.row_b;
  row.rolling = row.spinning = kNoPair;
  const ContactResponse<S>* const response = response_of(context.responses, contact);
  row.response = response == nullptr ? kNoPair : static_cast<std::uint32_t>(response - context.responses.data());
  const Masses masses = masses_of(context, row);
  const SolverMass<S>&a = masses.a, &b = masses.b;
  row.share = mass_share(a.mass, b.mass);
  row.most = highest<V>();
  if (response != nullptr) {
    row.share = response->share(a.mass, b.mass);
    const std::int32_t rate = integration_rate(SolverName::worst_first, context.hz, context.substeps);
    row.most = response->most_impulse(a.mass, b.mass, divide_to<Step<S>>(S(1), S(rate)));
  }
  const auto& at = g.points[point];
  const auto pushing = [&](Vec3<Unit<S>> d) {
    const Vec3<S> n = convert<S>(d);
    return detail::weighed_row(n, cross(at.arm_a, n), cross(at.arm_b, n), a, b, row.share);
  };
  const S linear = row.share.a + row.share.b;
  row.normal = pushing(g.normal);
  row.mass = detail::mass_of(detail::coupling_of(row.normal, row.normal, linear));
  const Tangents<Unit<S>> basis = friction_tangents(g);
  const auto rub = [&](int k, Vec3<Unit<S>> d) {
    row.friction.rows[k] = pushing(d);
    row.friction.surface[k] = saturate_to<V>(dot_sum(g.material.surface_velocity, d));
  };
  rub(0, basis.t);
  rub(1, basis.u);
  row.friction.ratio = g.ratio;
  detail::invert_pair(row.friction, linear);
  row.mu = g.material.friction;
  row.separation = convert<V>(at.separation);
  load_impulses(context.contacts[contact], point, row);
  if (g.material.rolling_resistance > S(0)) add_rolling(g, point, a, b, row);
  if (context.contacts[contact].count == 1) add_spinning(g, a, b, row);  // more points resist it by their friction
  points_.push_back(row);
}

template <class S, class Queue>
typename WorstFirstResolver<S, Queue>::Masses WorstFirstResolver<S, Queue>::masses_of(const StepContext<S>& context,
                                                                                      const Point& row) const {
  const SolverMass<S>&a = bodies_.rows().mass[row.a], &b = bodies_.rows().mass[row.b];
  if (row.response == kNoPair) return {a, b};
  const ContactResponse<S>& response = context.responses[row.response];
  return {response.seen_a(a), response.seen_b(b)};
}

/// Loads the impulses of the last step. A contact's friction was distributed over its points as its weight was.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::load_impulses(const Contact<S>& contact, std::uint32_t point, Point& row) {
  row.impulse = min(contact.normal_impulse[point], most_beside(points_.size(), row));
  row.total_impulse = -row.impulse;  // the first warm start is the last step's
  const V weight = total_normal_impulse(contact);
  if (!(V(0) < weight)) return;
  const S part = divide_to<S>(row.impulse, weight);
  for (int k = 0; k < 2; ++k) {
    const V friction = saturate_to<V>(dot_sum(contact.friction_impulse, row.friction.rows[k].linear));
    row.friction.impulse[k] = scaled(part, friction);
  }
}

/// Adds rolling rows as in soft step: their radius is the distance from the contact to the centre that rolls, which
/// keeps the coefficients near one.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::add_rolling(const ContactGeometry<S>& g, std::uint32_t point, const SolverMass<S>& a,
                                               const SolverMass<S>& b, Point& row) {
  const SolverBodies<S>& bodies = bodies_.rows();
  const auto distance = [&](std::uint32_t body, Vec3<S> arm) {
    return bodies.moves(body) ? abs(dot(arm, g.normal)) : S(0);
  };
  const S radius = max(distance(g.row_a, g.points[point].arm_a), distance(g.row_b, g.points[point].arm_b));
  if (!(S(0) < radius)) return;
  TangentPair<S> pair = {};
  const Tangents<Unit<S>> basis = tangents_of(g.normal);
  const auto turning = [&](Vec3<Unit<S>> axis) {
    const Vec3<S> jacobian = convert<S>(axis) * radius;
    return detail::weighed_row(Vec3<S>::zero(), jacobian, jacobian, a, b, row.share);
  };
  pair.rows[0] = turning(basis.t);
  pair.rows[1] = turning(basis.u);
  detail::invert_pair(pair, S(0));
  // Beyond the radius itself a body does not roll at all; four times it is no different and fits.
  row.lever = min(divide_to<S>(g.material.rolling_resistance, radius), S(4));
  row.rolling = static_cast<std::uint32_t>(rolling_.size());
  rolling_.push_back(pair);
}

/// Adds a spinning row as in soft step: friction at the radius of the least patch, in a row of the radius of gyration.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::add_spinning(const ContactGeometry<S>& g, const SolverMass<S>& a,
                                                const SolverMass<S>& b, Point& row) {
  S slope = saturate_to<S>(product(g.material.friction, g.material.spin_resistance));
  if (g.ratio < Unit<S>(1)) slope = round_to<S>(product(slope, spinning_factor(g.ratio)));
  const auto spinning = [&](S radius) {
    const Vec3<S> jacobian = convert<S>(g.normal) * radius;
    return detail::weighed_row(Vec3<S>::zero(), jacobian, jacobian, a, b, row.share);
  };
  const JointRow<S> unit = spinning(S(1));
  const S k = detail::coupling_of(unit, unit, S(0));
  if (!(S(0) < slope) || !(S(0) < k)) return;
  const S radius = min(divide_to<S>(S(1), sqrt(k)), Limits<S>::extent());
  TangentPair<S> pair = {};
  pair.rows[0] = spinning(radius);
  detail::invert_pair(pair, S(0));
  row.spin_lever = min(divide_to<S>(slope, radius), S(4));
  row.spinning = static_cast<std::uint32_t>(rolling_.size());
  rolling_.push_back(pair);
}

/// Renews rows of bodies whose turning the contacts follow: contact_follow.hpp.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::follow(const StepContext<S>& context) {
  for (Point& row : points_) {
    const bool by_a = bodies_.is_followed(context, row.a), by_b = bodies_.is_followed(context, row.b);
    if (!by_a && !by_b) continue;
    if (by_a) bodies_.renew_inertia(context, row.a);
    if (by_b) bodies_.renew_inertia(context, row.b);
    const Masses masses = masses_of(context, row);
    const auto renew = [&](JointRow<S>& r) {
      r = detail::weighed_row(r.linear, r.angular_a, r.angular_b, masses.a, masses.b, row.share);
    };
    const auto renew_pair = [&](TangentPair<S>& pair, S linear) {
      for (JointRow<S>& r : pair.rows) renew(r);
      detail::invert_pair(pair, linear);
    };
    const S linear = row.share.a + row.share.b;
    renew(row.normal);
    row.mass = detail::mass_of(detail::coupling_of(row.normal, row.normal, linear));
    renew_pair(row.friction, linear);
    if (row.rolling != kNoPair) renew_pair(rolling_[row.rolling], S(0));
    if (row.spinning != kNoPair) renew_pair(rolling_[row.spinning], S(0));
  }
}

/// Lists only rows that a resolved row can change: a thousand contacts with one floor are no neighbours.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::list_neighbours() {
  const std::size_t bodies = bodies_.rows().mass.size();
  first_.assign(bodies + 2, 0);  // counted two places on: filling leaves each list's start where it is looked for
  const auto each_end = [&](auto&& visit) ISO_INLINE_LAMBDA {
    for (std::uint32_t i = 0; i < ends_.size(); ++i) {
      if (ends_[i].a != 0) visit(ends_[i].a, i);
      if (ends_[i].b != 0) visit(ends_[i].b, i);
    }
  };
  each_end([&](std::uint32_t body, std::uint32_t) ISO_INLINE_LAMBDA { ++first_[body + 2]; });
  for (std::size_t b = 2; b < bodies + 2; ++b) first_[b] += first_[b - 1];
  if (neighbours_.size() < first_[bodies + 1]) neighbours_.resize(first_[bodies + 1]);
  each_end([&](std::uint32_t body, std::uint32_t i) ISO_INLINE_LAMBDA { neighbours_[first_[body + 1]++] = i; });
}

/// Looks again at the rows of a body, except `index` and those of `not_of`, which were looked at already.
template <class S, class Queue>
template <class Look>
void WorstFirstResolver<S, Queue>::look_again(const Look& look, std::uint32_t index, std::uint32_t body,
                                              std::uint32_t not_of) {
  if (body == 0) return;
  for (std::uint32_t k = first_[body]; k < first_[body + 1]; ++k) {
    const std::uint32_t other = neighbours_[k];
    if (other == index || (not_of != 0 && (ends_[other].a == not_of || ends_[other].b == not_of))) continue;
    urgency_[other] = look(other);
    worst_.replay(other, before());
  }
}

/// Ends an island whose budget is spent: none of its rows is resolved again.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::leave_island(std::uint32_t row) {
  bool urgent = false;
  for (std::uint32_t i = budgets_.budget_of(row).first_row; i != IslandBudgets::kNobody; i = budgets_.next_of(i)) {
    if (urgency_[i] == V(0)) continue;
    urgent = true;
    urgency_[i] = V(0);
    worst_.replay(i, before());
  }
  islands_left_ += urgent;
}

template <class S, class Queue>
template <class Look, class Apply>
void WorstFirstResolver<S, Queue>::resolve(const Look& look, const Apply& apply, std::uint32_t turns) {
  const auto count = static_cast<std::uint32_t>(ends_.size());
  if (count == 0) return;
  for (std::uint32_t i = 0; i < count; ++i) urgency_[i] = look(i);
  worst_.plant(count, before());
  budgets_.fill([turns](IslandBudgets::Budget& budget) ISO_INLINE_LAMBDA {
    budget.iterations = most_iterations(budget.rows, turns);
    budget.looks = most_looks(budget.rows, turns);
  });
  for (;;) {
    const std::uint32_t worst = worst_.first();
    const V was = urgency_[worst];
    if (was == V(0)) return;
    apply(worst);
    const V is = look(worst);
    urgency_[worst] = is < was ? is : V(0);
    worst_.replay(worst, before());
    const Ends ends = ends_[worst];
    look_again(look, worst, ends.a, 0);
    look_again(look, worst, ends.b, ends.a);
    const std::uint64_t looks = (first_[ends.a + 1] - first_[ends.a]) + (first_[ends.b + 1] - first_[ends.b]);
    IslandBudgets::Budget& budget = budgets_.budget_of(worst);
    budget.looks -= min(looks, budget.looks);
    if (--budget.iterations == 0 || budget.looks == 0) leave_island(worst);
  }
}

template <class S, class Queue> void WorstFirstResolver<S, Queue>::prepare(const StepContext<S>&) {}

template <class S, class Queue> void WorstFirstResolver<S, Queue>::solve_substeps(const StepContext<S>& context) {
  const std::int32_t rate = integration_rate(SolverName::worst_first, context.hz, context.substeps);
  const JointStep<S> step = {context.states.data(),
                             &bodies_.rows(),
                             S(rate),
                             divide_to<Step<S>>(S(1), S(rate)),
                             Softness<S>::rigid(),
                             rapid_angular_speed<S>(context.hz),
                             angular_speed_to_follow<S>(rate)};
  const auto points = static_cast<std::uint32_t>(points_.size());
  const auto joint = [&](std::uint32_t i) -> JointConstraint<S>& { return joints_[held_[i - points]]; };
  const std::uint32_t turns = context.projection == Projection::relaxed ? detail::kRelaxedTurns : 1;
  islands_left_ = 0;
  if (context.projection == Projection::velocity_based) take_back(context);
  for (std::int32_t substep = 0; substep < context.substeps; ++substep) {
    begin_velocities(context, step);
    const auto resolve_motions = [&] {
      resolve([&](std::uint32_t i) { return i < points ? motion_urgency(points_[i]) : motion_urgency(joint(i), step); },
              [&](std::uint32_t i) {
                if (i < points) resolve_motion(points_[i]);
                else resolve_motion(joint(i), step);
              },
              1);
    };
    resolve_motions();
    for (int sweep = 1; context.mechanisms.any() && sweep < kMechanismSweeps; ++sweep) {
      context.mechanisms.solve(bodies_.rows(), 1);
      resolve_motions();
    }
    if (context.mechanisms.couples) context.mechanisms.close(bodies_.rows());
    any_followed_ = bodies_.integrate_positions(context, 0, bodies_.count());
    if (any_followed_) follow(context);
    if (context.mechanisms.any()) context.mechanisms.relax(bodies_.rows());
    begin_positions(step);
    resolve([&](std::uint32_t i) { return i < points ? overlap_urgency(points_[i]) : error_urgency(joint(i), step); },
            [&](std::uint32_t i) {
              if (i < points) end_overlap(context, points_[i]);
              else project(context, joint(i), step);
            },
            turns);
    if (context.mechanisms.any()) context.mechanisms.end();
    joints_.add_impulses(context);
  }
}

template <class S, class Queue> void WorstFirstResolver<S, Queue>::store_impulses(const StepContext<S>& context) {
  for (std::size_t i = 0; i < context.contacts.size(); ++i) {
    Contact<S>& contact = context.contacts[i];
    for (V& impulse : contact.normal_impulse) impulse = V(0);
    contact.friction_impulse = Vec3<V>::zero();
    contact.twist_impulse = V(0);
    contact.flags &= ~contact_flag::kTouching;
    context.step_impulses[i] = V(0);
  }
  std::uint32_t last = kNoPair, place = 0;
  for (Point& row : points_) {
    place = row.contact == last ? place + 1 : 0;
    last = row.contact;
    Contact<S>& contact = context.contacts[row.contact];
    const V total = saturating_add(row.total_impulse, row.impulse);
    context.step_impulses[row.contact] = saturating_add(context.step_impulses[row.contact], total);
    if (total > V(0)) contact.flags |= contact_flag::kTouching;
    contact.normal_impulse[place] = row.impulse;
    for (int k = 0; k < 2; ++k) {
      const Vec3<V> part = scaled(row.friction.rows[k].linear, row.friction.impulse[k]);
      contact.friction_impulse = saturated_sum<S>(contact.friction_impulse, part);
    }
  }
  impacts_.store(context);
  bodies_.store(context, 0, bodies_.count());
  bodies_.hold_energy(context);
  joints_.store(context);
}

}  // namespace isostep
