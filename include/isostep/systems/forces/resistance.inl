// Bodies of resistance.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/math/affine.hpp"
#include "isostep/systems/forces/resistance.hpp"

namespace isostep {

template <class S> void Resistance<S>::begin_substep() {
  parts_.assign(sums_.accelerations().size(), 0);
  fading_.clear();
}
template <class S> void Resistance<S>::count(std::uint32_t row) {
  if (bodies_.moves(row)) ++parts_[row - 1];
}
template <class S> void Resistance<S>::fade(std::uint32_t row, S linear, S angular) {
  if (fading_.empty()) fading_.assign(parts_.size(), {S(0), S(0)});
  Rates& rates = fading_[row - 1];
  rates = {saturating_add(rates.linear, linear), saturating_add(rates.angular, angular)};
}
template <class S> void Resistance<S>::take_steady() {
  for (std::uint32_t row = 1; row <= fading_.size(); ++row) {
    if (fading_[row - 1].any()) count(row);
  }
  steady_ = sums_.accelerations();
}
template <class S> void Resistance<S>::solve_fading() {
  for (std::uint32_t row = 1; row <= fading_.size(); ++row) {
    const Rates rates = fading_[row - 1];
    if (S(0) < rates.linear) sums_.slow(row, next_velocity(row), slowed(row, rates.linear));
    if (S(0) < rates.angular) slow_turning(row, next_angular_velocity(row), rates.angular);
  }
}

template <class S> S Resistance<S>::mass_part(std::uint32_t row) const {
  const std::uint32_t parts = parts_[row - 1];
  const S mass = bodies_.mass(row).mass;
  return parts < 2 ? mass : max(mass / S(static_cast<int>(min(parts, kMostParts))), resolution<S>());
}
template <class S> Vec3<S> Resistance<S>::next_velocity(std::uint32_t row) const {
  const S scale = bodies_.properties(row).gravity_scale;
  const Vec3<S> gravity = bodies_.gravity(), pull = scale == S(1) ? gravity : gravity * scale;
  return convert<S>(bodies_.velocity(row).linear) + (steady_[row - 1].linear + pull) * bodies_.when().h;
}
template <class S> Vec3<S> Resistance<S>::next_angular_velocity(std::uint32_t row) const {
  return convert<S>(bodies_.velocity(row).angular) + steady_[row - 1].angular * bodies_.when().h;
}
template <class S> Vec3<S> Resistance<S>::next_velocity(const BodyEnd<S>& end) const {
  return next_velocity(end.row) + cross(next_angular_velocity(end.row), end.arm);
}

/// [1/s] The rate by which a sub-step slows a motion that fades at `rate`, on its part of the body's mass.
template <class S> S Resistance<S>::slowed(std::uint32_t row, S rate) const {
  const S parts = S(static_cast<int>(min(max(parts_[row - 1], 1u), kMostParts)));
  return rate / (S(1) + saturate_to<S>(product(rate * bodies_.when().h, parts)));
}
template <class S> void Resistance<S>::slow_turning(std::uint32_t row, Vec3<S> turning, S rate) {
  sums_.slow_turning(row, turning, slowed(row, rate));
}

/// Returns the inverse mass at a point of a body times its mass, in a frame. kappa makes it dimensionless.
template <class S> Mat3<S> Resistance<S>::give_of(const BodyEnd<S>& end, const Mat3<U>& axes) const {
  const Mat3<S>& kappa = bodies_.mass(end.row).kappa;
  Mat3<S> columns;
  for (int i = 0; i < 3; ++i) {
    const Vec3<S> way = convert<S>(axes.column(i));
    columns.rows[i] = transposed_times(axes, way + cross(kappa * cross(end.arm, way), end.arm));
  }
  return transpose(columns);
}
template <class S>
Vec3<S> Resistance<S>::settled(const BodyEnd<S>& end, const Mat3<U>& axes, const Mat3<S>& tensor,
                               Vec3<S> velocity) const {
  const Mat3<S> give = give_of(end, axes);
  const S mass = mass_part(end.row), most = highest<S>() * S(0.25);
  detail::Bounder<S> bounder;
  Mat3<S> slowing, system;  // h tensor / m; 1 - give times that
  for (int i = 0; i < 3; ++i) slowing.rows[i] = bounder.quotient(tensor.rows[i] * bodies_.when().h, mass, most);
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

}  // namespace isostep
