// Bodies of body_forces.hpp: what resists motion, by backward Euler, stable whatever its coefficients.
//
// Each force resists the velocity that the steady ones lead to, on its own equal part of the body's mass, so that many
// on one body are as stable as one (mass splitting: Tonge et al. 2012, SIGGRAPH) and their order does not matter: what
// is mirrored stays so.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/affine.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/systems/forces/body_forces.hpp"

namespace isostep {

/// After all that pushes, of which this takes what bodies are about to do.
template <class S> void BodyForces<S>::resist_all() {
  const RecordStore<S>& records = *state_.records;
  resisting_.assign(accelerations_.size(), 0);
  const auto count = [&](std::uint32_t row) {
    if (bodies_->moves(row)) ++resisting_[row - 1];
  };
  for (const Wet& wet : wet_) count(wet.row);
  for_each_taken(records.drags, [&](const BodyDrag<S>& drag) { count(map_.row_of(drag.body.slot)); });
  for_each_taken(records.aero_surfaces, [&](const AeroSurface<S>& s) { count(map_.row_of(s.body.slot)); });
  gather_damping();
  const auto is_damped = [&](std::uint32_t row) {
    return S(0) < damping_[row - 1].linear || S(0) < damping_[row - 1].angular;
  };
  for (std::uint32_t row = 1; row <= damping_.size(); ++row) {
    if (is_damped(row)) count(row);
  }
  steady_ = accelerations_;
  for (const Wet& wet : wet_) resist(wet);
  for_each_taken(records.drags, [&](const BodyDrag<S>& drag) { resist(drag); });
  for_each_taken(records.aero_surfaces, [&](const AeroSurface<S>& surface) { resist(surface); });
  for (std::uint32_t row = 1; row <= damping_.size(); ++row) {
    if (is_damped(row)) resist_damping(row);
  }
}

/// [kg] The part of a body that each of its resisting forces has.
template <class S> S BodyForces<S>::mass_part(std::uint32_t row) const {
  const std::uint32_t parts = resisting_[row - 1];
  const S mass = bodies_->mass[row].mass;
  return parts < 2 ? mass : max(mass / S(static_cast<int>(min(parts, kMostParts))), resolution<S>());
}
/// As the sub-step would leave it with the steady forces, before contacts and joints: what resists motion resists that,
/// so that it balances steady forces exactly.
template <class S> Vec3<S> BodyForces<S>::next_velocity(std::uint32_t row) const {
  const S scale = state_.awake.properties[row - 1].gravity_scale;
  const Vec3<S> pull = scale == S(1) ? state_.settings.gravity : state_.settings.gravity * scale;
  return convert<S>(bodies_->velocity[row].linear) + (steady_[row - 1].linear + pull) * h_;
}
template <class S> Vec3<S> BodyForces<S>::next_angular_velocity(std::uint32_t row) const {
  return convert<S>(bodies_->velocity[row].angular) + steady_[row - 1].angular * h_;
}

template <class S> void BodyForces<S>::resist(const BodyDrag<S>& drag) {
  const std::uint32_t row = map_.row_of(drag.body.slot);
  if (!bodies_->moves(row)) return;
  const SolverMass<S>& mass = bodies_->mass[row];
  const S part = mass_part(row), half = highest<S>() * S(0.5);
  detail::Bounder<S> bounder;
  // v' = v - h (linear + quadratic |v'|) v' / part: first |v'|, the root of 1 + a and b, then the rest.
  const Vec3<S> v = next_velocity(row) - wind_at(state_.awake.states[row - 1].centre);
  const S one = S(1) + bounder.quotient(drag.linear, part, half) * h_;
  const S b = bounder.quotient(drag.quadratic, part, half) * h_, speed = length(v);
  const S root = sqrt(saturate_to<S>(product(one, one) + product(saturate_to<S>(product(b, speed)), S(4))));
  const S next_speed = speed / (one * S(0.5) + root * S(0.5));
  const S c = saturating_add(drag.linear, saturate_to<S>(product(drag.quadratic, next_speed)));
  const S settled = bounder.quotient(c, mass.mass, half) / (S(1) + bounder.quotient(c, part, half) * h_);
  accelerate(row, -Vec3<S>{saturate_to<S>(product(v.x, settled)), saturate_to<S>(product(v.y, settled)),
                           saturate_to<S>(product(v.z, settled))});
  if (!(S(0) < drag.angular)) return;
  const S turning = bounder.quotient(drag.angular, mass.mass, half);
  const S largest = max(max_abs(mass.kappa.rows[0]), max(max_abs(mass.kappa.rows[1]), max_abs(mass.kappa.rows[2])));
  const S fastest = min(saturate_to<S>(product(turning, largest)), half);
  if (!(S(0) < largest)) return;
  slow_turning(row, (mass.kappa * next_angular_velocity(row)) / largest, fastest);
}
template <class S> void BodyForces<S>::resist_damping(std::uint32_t row) {
  const Damping& damping = damping_[row - 1];
  const Vec3<S> v = next_velocity(row);
  const S slowed_by = slowed(row, damping.linear);
  if (S(0) < damping.linear)
    accelerate(row, -Vec3<S>{saturate_to<S>(product(v.x, slowed_by)), saturate_to<S>(product(v.y, slowed_by)),
                             saturate_to<S>(product(v.z, slowed_by))});
  if (S(0) < damping.angular) slow_turning(row, next_angular_velocity(row), damping.angular);
}

/// [1/s] At which a motion that fades at a rate is slowed, on its part of the body's mass.
template <class S> S BodyForces<S>::slowed(std::uint32_t row, S rate) const {
  const S parts = S(static_cast<int>(min(max(resisting_[row - 1], 1u), kMostParts)));
  return rate / (S(1) + saturate_to<S>(product(rate * h_, parts)));
}
/// A turning [rad/s] that fades at a rate [1/s].
template <class S> void BodyForces<S>::slow_turning(std::uint32_t row, Vec3<S> way, S rate) {
  const S slowed_by = slowed(row, rate);
  Acceleration<S>& sum = accelerations_[row - 1];
  const S most = detail::most_acceleration(rate_, Limits<S>::angular_speed());
  detail::Bounder<S> turned;
  const Vec3<S> against = {turned.rounded(product(way.x, -slowed_by), most),
                           turned.rounded(product(way.y, -slowed_by), most),
                           turned.rounded(product(way.z, -slowed_by), most)};
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
  const S mass = mass_part(end.row), most = highest<S>() * S(0.25);
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
template <class S> void BodyForces<S>::resist(const AeroSurface<S>& surface) {
  const End end = end_at(surface.body, surface.point);
  if (!bodies_->moves(end.row)) return;
  const Quat<U> body = state_.awake.states[end.row - 1].orientation;
  const Mat3<U> axes = to_matrix(normalise(body * surface.orientation));
  Vec3<S> flow;
  if (!surface.is_under_water) flow = wind_at(end.at);
  else if (!is_under_water(end.row, end.at, flow)) return;
  const Vec3<S> next = next_velocity(end.row) + cross(next_angular_velocity(end.row), end.arm);
  const Vec3<S> through = next - flow;
  // The speed of now, which in balance is that of next: what the others lead to is more.
  const Mat3<S> tensor = detail::tensor_of(surface, length(end.velocity - flow));
  push(end, axes * settled(end, axes, tensor, transposed_times(axes, through)));
}

}  // namespace isostep
