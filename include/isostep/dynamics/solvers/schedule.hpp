// Schedule<S>: what tells soft step and projected Gauss-Seidel apart: how often what is done, and how softly.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/math/softness.hpp"

namespace isostep {

template <class S> struct Schedule {
  std::int32_t rate;      // [1/s] steps of integration
  std::int32_t substeps;  // steps of integration
  std::int32_t passes;    // over all constraints, in each of those
  bool relaxes;           // one more pass over contacts without push, after positions; joints always get it
  JointOrder joint_order;
  Softness<S> contact_softness, joint_softness;
  S penetration_bias;  // [1] an overlap that a step begins with counts as deeper by this much of itself
};

namespace detail {

// Contacts are springs of an eighth of the sub-step rate. A quarter, all that one spring alone allows, leaves a wall of
// 210 boxes trembling at 1e-3 J/kg, an eighth at 1e-9: springs that share a body stiffen one another and one pass over
// them does not converge. Nor do they at a damping of 5.5: 2e-7. Softer ones sag: a stack of n boxes would sag
// 4.5 n^2 / substeps^2 mm without kPenetrationBias, and one that would sag 100 buckles. The angle a sub-step is pi / 4
// whatever the rate, and so the coefficients are constants.
template <class S> inline constexpr S kContactAngle = S(0.785398163397448309616);  // [rad]
template <class S> inline constexpr S kContactDamping = S(4.5);                    // [1] of critical

// Sag lasts, trembling does not. So a step aims not at touching but higher, by kPenetrationBias of the overlap it
// begins with: springs are stiffer by that against what outlasts a step, no stiffer within it. Rest is at
// 1 / (1 + kPenetrationBias) of the sag. From step to step an error turns into -kPenetrationBias of itself at most:
// below 1 it dies out whatever the sub-steps. Deep overlap comes of impacts, which need no more push; the bound also
// keeps what is added small in every format.
template <class S> inline constexpr S kPenetrationBias = S(0.5);           // [1]
template <class S> inline constexpr S kMostPenetrationBias = S(1.0 / 64);  // [m]

// One relaxation takes back what pushes one overlap apart, not what many push against each other: thirty capsules of
// 20 cm that begin in one place left it at 7 m/s. Contacts deeper than bodies sag are relaxed so often again: 2 m/s.
// Those with a floor are solved once more before anything moves: what many press into it must not come out below.
template <class S> inline constexpr S kDeepOverlap = S(1.0 / 64);  // [m]
inline constexpr int kDeepRelaxations = 4;

/// The softness of soft step's contacts, and of struts beyond the end of their travel in every solver.
template <class S> Softness<S> contact_softness(S rate) {
  return soften(kContactAngle<S>, kContactDamping<S>, rate);
}

/// [1] The part of an error that Baumgarte's term closes in a step. Box2D and Bullet use it too: with less, errors
/// stay, with more, stacks jump.
template <class S> inline constexpr S kBaumgarte = S(0.2);

}  // namespace detail

/// Source:  Catto 2024, Solver2D ("Soft Step"); Macklin et al. 2019, Small Steps in Physics Simulation.
template <class S> Schedule<S> soft_step_schedule(const StepContext<S>& context) {
  const std::int32_t rate = integration_rate(SolverName::soft_step, context.hz, context.substeps);
  return {rate,
          context.substeps,
          1,
          true,
          JointOrder::trees,
          detail::contact_softness(S(rate)),
          joint_softness(S(rate)),
          detail::kPenetrationBias<S>};
}

/// Source:  Catto 2005, Iterative Dynamics with Temporal Coherence (GDC); Baumgarte 1972, Stabilization of constraints.
///          The solver of most engines before 2023, for comparison: the speed that closes a contact's error stays. That
///          of joints is taken back: it turned a body round its hinge faster with every step.
/// Differs: joints are solved one after another, except loop-free trees with a limit, a motor or a spring: these are
///          solved at once. In a step of a sixtieth neighbours take back too much of what those ask: 23 of 60 random
///          trees gained energy or came apart.
template <class S> Schedule<S> pgs_schedule(const StepContext<S>& context) {
  const std::int32_t rate = integration_rate(SolverName::pgs, context.hz, context.substeps);
  const Softness<S> baumgarte = {detail::kBaumgarte<S> * S(rate), S(1), S(0)};
  return {rate, 1, context.substeps, false, JointOrder::driven_trees, baumgarte, baumgarte, S(0)};
}

}  // namespace isostep
