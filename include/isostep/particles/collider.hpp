// Scenery that particles meet: planes and lines. Bodies of a rigid world are effects/particle_coupling.hpp's.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

using ColliderId = Id<struct ColliderTag>;

/// plane    all that lies at n.x < offset is solid
/// line     a segment that particles cannot come nearer to than its radius and theirs
enum class ColliderType : std::uint32_t { plane, line };

template <class S> struct Collider {
  ColliderType type = ColliderType::plane;
  Vec3<Unit<S>> normal = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};   // [1] of a plane, out of the ground
  S offset = S(0);                                               // [m] of a plane
  Vec3<S> start = {S(0), S(0), S(0)}, end = {S(0), S(0), S(0)};  // [m] of a line
  S radius = S(0);                                               // [m] of a line

  ISO_FIELDS(type, normal, offset, start, end, radius)
};

}  // namespace isostep
