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

/// The parameter Forces of act(), slow() and resist() in RecordRules. Kinds of records know nothing of the systems
/// above them. The header of each part tells what it offers:
///   bodies      the rows, and which of them move; a body's row, pose, mass, velocity, a point of it;
///               gravity, the clock
///   sums        push(), accelerate(): every force goes here, and nowhere else
///   zones       the wind at a point; whether zones or waters of higher priority hide something there
///   resistance  for resist(): the velocity to resist, with which part of the mass. For slow(): rates of fading
///   wet         what a body displaces; whether a point is under water
///   shields     the point of a body that a blast hits, and whether a static body shields it
template <class S> struct RecordForces {
  const SubstepBodies<S>& bodies;
  ForceSums<S>& sums;
  const Zones<S>& zones;
  Resistance<S>& resistance;
  WetBodies<S>& wet;
  const BlastShields<S>& shields;
};

}  // namespace isostep
