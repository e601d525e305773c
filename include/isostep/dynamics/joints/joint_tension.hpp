// Tension: how hard joints pull at a light link, and the inertia that it has for a step too long to follow.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/dynamics/joints/symmetric_factors.hpp"

namespace isostep::detail {

template <class S> struct Pull {
  Vec3<Unit<S>> axis;  // along the arm
  S stiffness;         // [m^2] h^2 f.r / mass
};
/// Returns the pull on an arm: the impulse share_b lambda = f h / mass pulls b's arm outwards.
template <class S> ISO_INLINE Pull<S> pull_on(const JointConstraint<S>& joint, bool on_a, Step<S> h) {
  const Vec3<S> arm = on_a ? joint.arm_a : joint.arm_b;
  const Vec3<Velocity<S>> f = visit_joint_type(
      joint.properties.type, [&](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<S>::pull(joint); });
  const S share = on_a ? -joint.share.a : joint.share.b;
  const S along = share * saturate_to<S>(dot_sum(arm, f));  // [m^2/s]
  if (!(along > S(0))) return {Vec3<Unit<S>>::zero(), S(0)};
  const Direction<S> axis = direction_of(arm.x, arm.y, arm.z);
  return {{axis.x, axis.y, axis.z}, along * h};
}
/// Returns s (1 - n n^T).
template <class S> ISO_INLINE Mat3<S> across(Vec3<Unit<S>> n, S s) {
  const S xy = -(s * (n.x * n.y)), xz = -(s * (n.x * n.z)), yz = -(s * (n.y * n.z));
  return {{{s - s * (n.x * n.x), xy, xz}, {xy, s - s * (n.y * n.y), yz}, {xz, yz, s - s * (n.z * n.z)}}};
}
/// Adds the stiffness of a joint's pull to its bodies, by row. Rows that nothing pulled at before are added to `taut`.
template <class S>
ISO_INLINE void add_tension(const JointConstraint<S>& joint, const SolverBodies<S>& bodies, Step<S> h,
                            std::vector<Mat3<S>>& tension, std::vector<std::uint32_t>& taut) {
  for (const bool is_a : {true, false}) {
    const std::uint32_t row = is_a ? joint.row_a : joint.row_b;
    if (!bodies.moves(row)) continue;
    const Pull<S> pull = pull_on(joint, is_a, h);
    if (!(pull.stiffness > S(0))) continue;
    Mat3<S>& sum = tension[row];
    if (sum.rows[0].x + sum.rows[1].y + sum.rows[2].z == S(0)) taut.push_back(row);
    sum = sum + across(pull.axis, pull.stiffness);
  }
}
/// Source:  Andrews, Teichmann, Kovecses 2017, Geometric Stiffness for Real-time Constrained Multibody Dynamics,
///          Computer Graphics Forum 36(2): the stiffness that tension gives a light link is added to its inertia, as in
///          an implicit integrator, but only as far as the sub-step is too long for it.
/// Symbols: kappa tension = (angular frequency h)^2; explicit steps follow it below 4.
template <class S> ISO_INLINE Mat3<S> stiffened(const Mat3<S>& kappa, const Mat3<S>& tension) {
  const auto square = [&](int i) ISO_INLINE_LAMBDA { return round_to<S>(dot_sum(kappa.rows[i], tension.rows[i])); };
  const S stiffness = square(0) + square(1) + square(2);  // twice, for two axes turn
  if (!(stiffness > S(2) * kTautLimit<S>)) return kappa;
  const S largest = max(kappa.rows[0].x, max(kappa.rows[1].y, kappa.rows[2].z));
  const S unit = S(1) / largest;  // [m^2] brings both inverses near one
  const S excess = S(1) - S(2) * kTautLimit<S> / stiffness;
  Mat3<S> inertia = invert_symmetric(scaled_by(kappa, unit), S(0x1p-12));
  inertia = inertia + scaled_by(scaled_by(tension, largest), excess);
  return scaled_by(invert_symmetric(inertia, S(0)), largest);
}

}  // namespace isostep::detail
