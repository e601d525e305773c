// Rows of the worst-first resolver: a contact point's normal, its friction, what resists rolling and spinning, and
// their impulses.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/solvers/row_pushes.hpp"

namespace isostep {

/// A point of a contact. Impulses are velocity changes of the pair's reduced mass, as in Contact.
template <class S> struct PointRow {
  using V = Velocity<S>;
  std::uint32_t contact;   // of the context's
  std::uint32_t a, b;      // of SolverBodies
  std::uint32_t rolling;   // of the resolver's pairs; kNoPair for none
  std::uint32_t spinning;  // of those too: its second row is nothing
  std::uint32_t response;  // of the context's; kNoPair for none
  MassShare<S> share;
  JointRow<S> normal;  // turns hold the mass shares
  TangentPair<S> friction;
  S mass;           // [1] effective, along the normal
  S mu;             // [1] coefficient of friction
  S lever;          // [1] resisting torque per normal impulse, over the pair's radius
  S spin_lever;     // [1] that of spinning
  V separation;     // [m] when the step began
  V least_speed;    // [m/s] the gap may close in the sub-step, no more
  V least_gap;      // [m] what this sub-step's projection aims at
  V impulse;        // [m/s] of this sub-step
  V total_impulse;  // [m/s] of the sub-steps before
  V most;           // [m/s] that all points of its contact bear in a sub-step; the highest of the format for any

  ISO_FIELDS(contact, a, b, rolling, spinning, response, share, normal, friction, mass, mu, lever, spin_lever,
             separation, least_speed, least_gap, impulse, total_impulse, most)
};
inline constexpr std::uint32_t kNoPair = 0xffffffffu;

}  // namespace isostep
