// Cohesion: particles of one material, as in a blob, push each other away when near and pull when a little apart.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

using CohesionId = Id<struct CohesionTag>;

/// The force between two particles at distance d: away from each other from repel_force at d = 0 falling to 0 at
/// repel_distance; towards each other from 0 at attract_start growing to attract_force at attract_end, and none beyond.
/// Source:  Millington, ch. 8.3 and its blob demo.  Differs: repulsion is greatest where they touch, not zero.
template <class S> struct Cohesion {
  ParticleMaterialId material = {};
  S repel_distance = S(0);  // [m]
  S repel_force = S(0);     // [N]
  S attract_start = S(0);   // [m] at least repel_distance
  S attract_end = S(0);     // [m] at least attract_start
  S attract_force = S(0);   // [N]

  ISO_FIELDS(material, repel_distance, repel_force, attract_start, attract_end, attract_force)
};

}  // namespace isostep
