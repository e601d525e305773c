// Bodies of body_forces.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/transform.hpp"
#include "isostep/systems/forces/body_forces.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE Acceleration<S> difference(const Acceleration<S>& a, const Acceleration<S>& b) {
  return {saturating_subtract(a.linear, b.linear), saturating_subtract(a.angular, b.angular)};
}
}  // namespace detail

template <class S> void BodyForces<S>::begin_step() {
  accelerations_.clear();
  pulls_.clear();
  cut_.clear();
  substep_ = 0;
  cut_count_ = 0;
  wheels_.begin_step();
  couplings_.begin_step();
  const Acceleration<S> none = {Vec3<S>::zero(), Vec3<S>::zero()};
  if (state_.forces.empty() && no_records()) return;
  accelerations_.assign(state_.awake.states.size(), none);
  for (const PendingForce<S>& force : state_.forces) {
    const std::uint32_t index = map_.location(force.slot).index;
    accelerations_[index] = {force.linear, force.angular};
    note_cut(index + 1, force.cut != 0);
  }
  state_.forces.clear();
  asked_ = accelerations_;
}
template <class S> void BodyForces<S>::end_step(StepReport& report) {
  report.clamped_force += cut_count_;
  remove_ended();
  wheels_.end_step();
}

template <class S> SubstepForces<S> BodyForces<S>::substeps() {
  if (no_records()) return {};
  const auto renew = [](void* forces, const SolverBodies<S>& bodies, std::int32_t rate) {
    static_cast<BodyForces*>(forces)->renew(bodies, rate);
  };
  return {renew, this};
}

template <class S> void BodyForces<S>::renew(const SolverBodies<S>& bodies, std::int32_t rate) {
  bodies_ = &bodies;
  rate_ = rate;
  h_ = divide_to<Step<S>>(S(1), S(rate));
  substeps_ = static_cast<std::uint32_t>(rate / state_.settings.hz);
  if (substep_ == 0) rank_zones();
  accelerations_ = asked_;
  pulls_.assign(is_last() ? accelerations_.size() : 0, {Vec3<S>::zero(), Vec3<S>::zero()});
  wet_.clear();
  wet_.reserve(water_ranks_.size() * accelerations_.size());
  RecordStore<S>::members([&](const char*, const auto& registry) { act_all(registry); }, *state_.records);
  act_in_place_of_gravity();
  resist_all();
  const auto push_all = [&](std::span<const VelocityChange<S>> changes) {
    for (const VelocityChange<S>& change : changes) push(change);
  };
  if (wheels_.any()) bear([&] { push_all(wheels_.solve(bodies, accelerations_, rate)); });
  if (couplings_.any()) bear([&] { push_all(couplings_.solve(bodies, accelerations_, rate)); });
  for (std::size_t i = 0; i < pulls_.size(); ++i) pulls_[i] = detail::difference(accelerations_[i], pulls_[i]);
  ++substep_;
}

/// Each record of a kind that acts.
template <class S>
template <class Record, class IdType>
void BodyForces<S>::act_all(const Registry<Record, IdType>& registry) {
  if constexpr (acts<Record>()) {
    const auto all = [&] { for_each_taken(registry, [&](const auto& record) { act(record); }); };
    if (registry.all().empty()) return;
    if constexpr (detail::RecordRules<Record>::kBears) bear(all);
    else all();
  }
}
/// In the last sub-step `pulls_` are, until it ends, what bears.
template <class S> template <class Act> void BodyForces<S>::bear(const Act& act) {
  if (!is_last()) return act();
  before_ = accelerations_;
  act();
  for (std::size_t i = 0; i < pulls_.size(); ++i) {
    const Acceleration<S> borne = detail::difference(accelerations_[i], before_[i]);
    pulls_[i] = {saturating_add(pulls_[i].linear, borne.linear), saturating_add(pulls_[i].angular, borne.angular)};
  }
}

// ---- what all of them use

/// Ascending by slot; zones and waters by (priority, slot).
template <class S>
template <class Registry, class Visit>
void BodyForces<S>::for_each_taken(const Registry& registry, const Visit& visit) const {
  using Record = std::remove_cvref_t<decltype(registry.all()[0])>;
  if constexpr (std::is_same_v<Record, ForceZone<S>>) return for_each_ranked(zone_ranks_, registry.all(), visit);
  if constexpr (std::is_same_v<Record, Water<S>>) return for_each_ranked(water_ranks_, registry.all(), visit);
  for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
    if (registry.is_taken(slot)) visit(registry.all()[slot]);
  }
}
template <class S>
template <class Record, class Visit>
void BodyForces<S>::for_each_ranked(std::span<const std::uint64_t> ranks, const std::vector<Record>& all,
                                    const Visit& visit) const {
  for (const std::uint64_t rank : ranks) visit(all[rank & 0xffffffffu]);
}

template <class S> typename BodyForces<S>::End BodyForces<S>::end_at(BodyId body, Vec3<S> local) const {
  if (!body) return {0, local, Vec3<S>::zero(), Vec3<S>::zero()};
  const Location at = map_.location(body.slot);
  const BodyState<S>& state = map_.state_at(at);
  const std::uint32_t row = map_.row_of(body.slot);
  const Vec3<S> arm = rotate(state.orientation, local - map_.properties_at(at).local_centre);
  const MotionRow<Velocity<S>>& v = bodies_->velocity[row];
  return {row, state.centre + arm, arm, convert<S>(v.linear) + cross(convert<S>(v.angular), arm)};
}
/// Whether the row's body is dynamic and of one of those categories.
template <class S> bool BodyForces<S>::is_pushed(std::uint32_t row, std::uint32_t mask) const {
  return bodies_->moves(row) && (state_.awake.properties[row - 1].filter.category & mask) != 0;
}

template <class S> void BodyForces<S>::note_cut(std::uint32_t row, bool cut) {
  if (!cut || cut_.test(row - 1)) return;
  cut_.set(row - 1);
  ++cut_count_;
}
template <class S> void BodyForces<S>::accelerate(std::uint32_t row, Vec3<S> acceleration) {
  const S most = detail::most_acceleration(rate_, Limits<S>::speed());
  detail::Bounder<S> bounder;
  Vec3<S>& linear = accelerations_[row - 1].linear;
  for (int axis = 0; axis < 3; ++axis) acceleration[axis] = bounder.held(acceleration[axis], most);
  linear = bounder.sum(linear, acceleration, most);
  note_cut(row, bounder.cut);
}
/// A force [N] that acts at an arm from the centre of mass.
template <class S> void BodyForces<S>::push(std::uint32_t row, Vec3<S> force, Vec3<S> arm) {
  if (!bodies_->moves(row)) return;
  const SolverMass<S>& mass = bodies_->mass[row];
  const S most = detail::most_acceleration(rate_, Limits<S>::speed());
  const S most_turning = detail::most_acceleration(rate_, detail::most_angular_speed(state_.awake.states[row - 1].fat));
  detail::Bounder<S> bounder;
  Acceleration<S>& sum = accelerations_[row - 1];
  sum.linear = bounder.sum(sum.linear, bounder.quotient(force, mass.mass, most), most);
  if (!(arm == Vec3<S>::zero())) {
    const Vec3<S> turning = bounder.turning(mass.kappa, detail::saturated_cross(arm, force), mass.mass, most_turning);
    sum.angular = bounder.sum(sum.angular, turning, most_turning);
  }
  note_cut(row, bounder.cut);
}
/// Of wheels and couplings, which know what they do to a body's velocity.
template <class S> void BodyForces<S>::push(const VelocityChange<S>& change) {
  const S most = detail::most_acceleration(rate_, Limits<S>::speed());
  const S most_turning =
      detail::most_acceleration(rate_, detail::most_angular_speed(state_.awake.states[change.row - 1].fat));
  detail::Bounder<S> bounder;
  const auto rate_of = [&](Vec3<Velocity<S>> v, S limit) {
    const auto part = [&](Velocity<S> x) { return bounder.held(saturate_to<S>(product(S(rate_), x)), limit); };
    return Vec3<S>{part(v.x), part(v.y), part(v.z)};
  };
  Acceleration<S>& sum = accelerations_[change.row - 1];
  sum.linear = bounder.sum(sum.linear, rate_of(change.linear, most), most);
  sum.angular = bounder.sum(sum.angular, rate_of(change.angular, most_turning), most_turning);
  note_cut(change.row, bounder.cut);
}

// ---- attractors: for every awake body

template <class S> void BodyForces<S>::act(const Attractor<S>& attractor) {
  if (attractor.body && !map_.is_enabled(attractor.body.slot)) return;
  const End source = attractor.body ? end_at(attractor.body, map_.properties_of(attractor.body)->local_centre)
                                    : end_at({}, attractor.point);
  const S most = detail::most_acceleration(rate_, Limits<S>::speed());
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    if (row == source.row || !is_pushed(row, attractor.mask)) continue;
    const Heading<S> way = heading_of(source.at - state_.awake.states[row - 1].centre);
    if (S(0) < attractor.range && attractor.range < way.length) continue;
    const S distance = max(way.length, attractor.least_distance);
    detail::Bounder<S> bounder;
    const S size = bounder.quotient(bounder.quotient(attractor.strength, distance, highest<S>()), distance, most);
    note_cut(row, bounder.cut);
    accelerate(row, way.direction * size);
    if (source.row == 0 || !bodies_->moves(source.row)) continue;
    const S force = saturate_to<S>(product(size, bodies_->mass[row].mass));
    push(source.row, way.direction * -force, Vec3<S>::zero());
  }
}

// ---- springs, thrusters, buoyancy

template <class S> void BodyForces<S>::act(const BodySpring<S>& spring) {
  for (const BodyId end : {spring.a, spring.b}) {
    if (end && !map_.is_enabled(end.slot)) return;
  }
  const End a = end_at(spring.a, spring.anchor_a), b = end_at(spring.b, spring.anchor_b);
  if (!bodies_->moves(a.row) && !bodies_->moves(b.row)) return;
  const Heading<S> way = heading_of(b.at - a.at);
  const S stretch = way.length - spring.rest_length;
  if (spring.only_pulls && !(S(0) < stretch)) return;
  const S rate = dot(b.velocity - a.velocity, way.direction);
  S pull = saturate_to<S>(product(spring.stiffness, stretch) + product(spring.damping, rate));
  if (spring.only_pulls) pull = max(pull, S(0));
  push(a, way.direction * pull);
  push(b, way.direction * -pull);
}
template <class S> void BodyForces<S>::act(const Thruster<S>& thruster) {
  const End end = end_at(thruster.body, thruster.point);
  if (end.row != 0) push(end, rotate(state_.awake.states[end.row - 1].orientation, thruster.force));
}
template <class S> void BodyForces<S>::act(const BuoyancyPoint<S>& buoyancy) {
  const End end = end_at(buoyancy.body, buoyancy.point);
  const Heading<S> down = heading_of(state_.settings.gravity);
  const S sunk = buoyancy.surface_height + buoyancy.max_depth + dot(end.at, down.direction);
  const S share = clamp(sunk / (buoyancy.max_depth + buoyancy.max_depth), S(0), S(1));
  const S displaced = saturate_to<S>(product(saturate_to<S>(product(buoyancy.density, buoyancy.volume)), share));
  push(end, down.direction * -saturate_to<S>(product(displaced, down.length)));
}

}  // namespace isostep
