// Cables and rods: hard constraints between two particles, or a particle and a fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

using LinkId = Id<struct LinkTag>;

/// cable  at most `length` apart; at the end it bounces by its restitution
/// rod    exactly `length` apart
enum class LinkType : std::uint32_t { cable, rod };

template <class S> struct Link {
  LinkType type = LinkType::cable;
  ParticleId a = {}, b = {};            // b null: the anchor
  Vec3<S> anchor = {S(0), S(0), S(0)};  // [m] world; used where b is null
  S length = S(1);                      // [m]
  S restitution = S(0);                 // [1] of a cable

  ISO_FIELDS(type, a, b, anchor, length, restitution)
};

}  // namespace isostep
