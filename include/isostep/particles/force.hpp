// Forces on one particle: the book's generators that are not springs, registered and removed one by one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

using ForceId = Id<struct ForceTag>;

enum class ForceType : std::uint32_t { gravity, drag, buoyancy };

/// gravity   m acceleration
/// drag      -v (linear_drag + quadratic_drag |v|)
/// buoyancy  up, as the weight of the liquid that is displaced: share s of the volume under water, where s goes from 0
///           to 1 while the particle sinks from max_depth above the surface to max_depth below it. Up is against the
///           world's gravity, whose strength it has.
template <class S> struct ParticleForce {
  ForceType type = ForceType::gravity;
  ParticleId particle = {};
  Vec3<S> acceleration = {S(0), S(0), S(0)};  // [m/s^2]
  S linear_drag = S(0);                       // [N s/m]
  S quadratic_drag = S(0);                    // [N s^2/m^2]
  S max_depth = S(0);                         // [m]
  S volume = S(0);                            // [m^3]
  S surface_height = S(0);                    // [m] of the liquid's surface, along up
  S density = S(0);                           // [kg/m^3] of the liquid

  ISO_FIELDS(type, particle, acceleration, linear_drag, quadratic_drag, max_depth, volume, surface_height, density)
};

}  // namespace isostep
