// RecordForces<S>: what a kind of record that acts in a sub-step has to act with.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/forces/blast_shields.hpp"
#include "isostep/systems/forces/force_sums.hpp"
#include "isostep/systems/forces/resistance.hpp"
#include "isostep/systems/forces/substep_bodies.hpp"
#include "isostep/systems/forces/wet_bodies.hpp"
#include "isostep/systems/forces/zones.hpp"

namespace isostep {

/// The Forces of act(), slow() and resist() of RecordRules, a parameter there: kinds know nothing of what is above
/// them. Each part's header says what it offers:
///   bodies      which rows there are and which of them move; a body's row, pose, mass, velocity, a point of it;
///               gravity, the clock
///   sums        push(), accelerate(): what acts goes here, and nowhere else
///   zones       the wind at a point; whether zones or waters of higher priority hide something there
///   resistance  of resist(): the velocity to resist, on which part of the mass. Of slow(): the rates of what fades
///   wet         what a body displaces; whether a point is under water
///   shields     which point of a body a blast meets, and what keeps it off
template <class S> struct RecordForces {
  const SubstepBodies<S>& bodies;
  ForceSums<S>& sums;
  const Zones<S>& zones;
  Resistance<S>& resistance;
  WetBodies<S>& wet;
  const BlastShields<S>& shields;
};

}  // namespace isostep
