// Bodies of body_forces.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/affine.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/world/body_forces.hpp"

namespace isostep {

template <class S> void BodyForces<S>::begin_step() {
  accelerations_.clear();
  cut_.clear();
  cut_count_ = 0;
  const Acceleration<S> none = {Vec3<S>::zero(), Vec3<S>::zero()};
  if (state_.forces.empty() && state_.force_records->untouched()) return;
  accelerations_.assign(state_.awake.states.size(), none);
  for (const PendingForce<S>& force : state_.forces) {
    const std::uint32_t index = map_.location(force.slot).index;
    accelerations_[index] = {force.linear, force.angular};
    note_cut(index + 1, force.cut != 0);
  }
  state_.forces.clear();
  asked_ = accelerations_;
}
template <class S> void BodyForces<S>::end_step(StepReport& report) { report.clamped_force += cut_count_; }

template <class S> SubstepForces<S> BodyForces<S>::substeps() {
  if (state_.force_records->untouched()) return {};
  const auto renew = [](void* forces, const SolverBodies<S>& bodies, std::int32_t rate) {
    static_cast<BodyForces*>(forces)->renew(bodies, rate);
  };
  return {renew, this};
}

template <class S> void BodyForces<S>::renew(const SolverBodies<S>& bodies, std::int32_t rate) {
  bodies_ = &bodies;
  rate_ = rate;
  h_ = divide_to<Step<S>>(S(1), S(rate));
  accelerations_ = asked_;
  ForceRecords<S>::members(
      [&](const char*, const auto& registry) {
        for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
          if (registry.is_taken(slot)) act(registry.all()[slot]);
        }
      },
      *state_.force_records);
}

// ---- what all of them use

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
  const S most_turning =
      detail::most_acceleration(rate_, detail::most_angular_speed(state_.awake.states[row - 1].fat));
  detail::Bounder<S> bounder;
  Acceleration<S>& sum = accelerations_[row - 1];
  sum.linear = bounder.sum(sum.linear, bounder.quotient(force, mass.mass, most), most);
  if (!(arm == Vec3<S>::zero())) {
    const Vec3<S> turning =
        bounder.turning(mass.kappa, detail::saturated_cross(arm, force), mass.mass, most_turning);
    sum.angular = bounder.sum(sum.angular, turning, most_turning);
  }
  note_cut(row, bounder.cut);
}

/// As the sub-step would leave it with the forces so far, before contacts and joints: what resists motion resists that,
/// so that it balances steady forces exactly.
template <class S> Vec3<S> BodyForces<S>::next_velocity(std::uint32_t row) const {
  const S scale = state_.awake.properties[row - 1].gravity_scale;
  const Vec3<S> pull = scale == S(1) ? state_.settings.gravity : state_.settings.gravity * scale;
  return convert<S>(bodies_->velocity[row].linear) + (accelerations_[row - 1].linear + pull) * h_;
}
template <class S> Vec3<S> BodyForces<S>::next_angular_velocity(std::uint32_t row) const {
  return convert<S>(bodies_->velocity[row].angular) + accelerations_[row - 1].angular * h_;
}

// ---- zones and attractors: for every awake body

namespace detail {
template <class S> ISO_INLINE bool is_inside(const ForceZone<S>& zone, Vec3<S> point) {
  if (zone.shape == ZoneShape::everywhere) return true;
  const Vec3<S> from_middle = point - zone.pose.position;
  if (zone.shape == ZoneShape::sphere) return length(from_middle) <= zone.half.x;
  const Vec3<S> local = transposed_times(to_matrix(zone.pose.orientation), from_middle);
  return within(local.x, zone.half.x) && within(local.y, zone.half.y) && within(local.z, zone.half.z);
}
}  // namespace detail

template <class S> void BodyForces<S>::act(const ForceZone<S>& zone) {
  if (zone.acceleration == Vec3<S>::zero()) return;
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    if (!is_pushed(row, zone.mask) || !detail::is_inside(zone, state_.awake.states[row - 1].centre)) continue;
    accelerate(row, zone.acceleration);
  }
}
template <class S> Vec3<S> BodyForces<S>::wind_at(Vec3<S> point) const {
  Vec3<S> wind = Vec3<S>::zero();
  const auto& zones = state_.force_records->force_zones;
  for (std::uint32_t slot = 0; slot < zones.all().size(); ++slot) {
    const ForceZone<S>& zone = zones.all()[slot];
    if (zones.is_taken(slot) && detail::is_inside(zone, point)) wind = saturating_add(wind, zone.wind);
  }
  return held_within(wind, Limits<S>::speed());
}

template <class S> void BodyForces<S>::act(const Attractor<S>& attractor) {
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

// ---- what resists motion: backward Euler, stable whatever its coefficients

template <class S> void BodyForces<S>::act(const BodyDrag<S>& drag) {
  const std::uint32_t row = map_.row_of(drag.body.slot);
  if (!bodies_->moves(row)) return;
  const SolverMass<S>& mass = bodies_->mass[row];
  detail::Bounder<S> bounder;
  const S half = highest<S>() * S(0.5);
  // v' = v - h (linear + quadratic |v'|) v' / m: first |v'|, the root of 1 + a and b, then the rest.
  const Vec3<S> v = next_velocity(row) - wind_at(state_.awake.states[row - 1].centre);
  const S one = S(1) + bounder.quotient(drag.linear, mass.mass, half) * h_;
  const S b = bounder.quotient(drag.quadratic, mass.mass, half) * h_, speed = length(v);
  const S root = sqrt(saturate_to<S>(product(one, one) + product(saturate_to<S>(product(b, speed)), S(4))));
  const S next_speed = speed / (one * S(0.5) + root * S(0.5));
  const S c = saturating_add(drag.linear, saturate_to<S>(product(drag.quadratic, next_speed)));
  const S rate = bounder.quotient(c, mass.mass, half), settled = rate / (S(1) + rate * h_);
  accelerate(row, -Vec3<S>{saturate_to<S>(product(v.x, settled)), saturate_to<S>(product(v.y, settled)),
                           saturate_to<S>(product(v.z, settled))});
  if (!(S(0) < drag.angular)) return;
  const S turning = bounder.quotient(drag.angular, mass.mass, half);
  const S largest = max(max_abs(mass.kappa.rows[0]), max(max_abs(mass.kappa.rows[1]), max_abs(mass.kappa.rows[2])));
  const S fastest = min(saturate_to<S>(product(turning, largest)), half);
  if (!(S(0) < largest)) return;
  const Vec3<S> w = (mass.kappa * next_angular_velocity(row)) / largest;
  const S slowed = fastest / (S(1) + fastest * h_);
  Acceleration<S>& sum = accelerations_[row - 1];
  const S most = detail::most_acceleration(rate_, Limits<S>::angular_speed());
  detail::Bounder<S> turned;
  const Vec3<S> against = {turned.rounded(product(w.x, -slowed), most), turned.rounded(product(w.y, -slowed), most),
                           turned.rounded(product(w.z, -slowed), most)};
  sum.angular = turned.sum(sum.angular, against, most);
  note_cut(row, turned.cut);
}

/// How much a point of a body gives way to a unit of force per mass, seen in a frame: kappa's part is dimensionless.
template <class S> Mat3<S> BodyForces<S>::give_of(const End& end, const Mat3<U>& axes) const {
  const Mat3<S>& kappa = bodies_->mass[end.row].kappa;
  Mat3<S> columns;
  for (int i = 0; i < 3; ++i) {
    const Vec3<S> way = convert<S>(axes.column(i));
    columns.rows[i] = transposed_times(axes, way + cross(kappa * cross(end.arm, way), end.arm));
  }
  return transpose(columns);
}
/// tensor v', where v' is what `velocity` (both of the frame `axes`) becomes by that force in the sub-step: v' = v +
/// h K tensor v', with K what the point gives way.
template <class S>
Vec3<S> BodyForces<S>::settled(const End& end, const Mat3<U>& axes, const Mat3<S>& tensor, Vec3<S> velocity) const {
  const Mat3<S> give = give_of(end, axes);
  const S mass = bodies_->mass[end.row].mass, most = highest<S>() * S(0.25);
  detail::Bounder<S> bounder;
  Mat3<S> slowing, system;  // h tensor / m; 1 - give times that
  for (int i = 0; i < 3; ++i) slowing.rows[i] = bounder.quotient(tensor.rows[i] * h_, mass, most);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const S part = bounder.rounded(dot_sum(give.rows[i], slowing.column(j)), most);
      system.rows[i][j] = (i == j ? S(1) : S(0)) - part;
    }
  }
  const Inverse<Mat3<S>> solved = inverse_of(system);
  const Vec3<S> next = solved.exists ? solved.inverse * velocity : velocity;
  return {saturate_to<S>(dot_sum(tensor.rows[0], next)), saturate_to<S>(dot_sum(tensor.rows[1], next)),
          saturate_to<S>(dot_sum(tensor.rows[2], next))};
}
namespace detail {
template <class S> Mat3<S> tensor_of(const AeroSurface<S>& surface, S speed) {
  const Mat3<S>& end = surface.control < S(0) ? surface.low : surface.high;
  const S part = abs(surface.control), rest = S(1) - part;
  Mat3<S> tensor;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const S mixed = round_to<S>(product(surface.tensor.rows[i][j], rest) + product(end.rows[i][j], part));
      tensor.rows[i][j] = surface.is_quadratic ? saturate_to<S>(product(mixed, speed)) : mixed;
    }
  }
  return tensor;
}
}  // namespace detail
template <class S> void BodyForces<S>::act(const AeroSurface<S>& surface) {
  const End end = end_at(surface.body, surface.point);
  if (!bodies_->moves(end.row)) return;
  const Quat<U> body = state_.awake.states[end.row - 1].orientation;
  const Mat3<U> axes = to_matrix(normalise(body * surface.orientation));
  const Vec3<S> wind = wind_at(end.at);
  const Vec3<S> next = next_velocity(end.row) + cross(next_angular_velocity(end.row), end.arm);
  const Vec3<S> through_air = next - wind;
  // The speed of now, which in balance is that of next: what the others lead to is more.
  const Mat3<S> tensor = detail::tensor_of(surface, length(end.velocity - wind));
  push(end, axes * settled(end, axes, tensor, transposed_times(axes, through_air)));
}

}  // namespace isostep
