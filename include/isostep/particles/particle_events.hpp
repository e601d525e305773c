// Events and reports of a step of particles for the game: output of one step, in canonical order, never state.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/particles/collider.hpp"
#include "isostep/particles/particle.hpp"
#include "isostep/particles/spring.hpp"

namespace isostep {

/// The lifetime of a particle ended. The particle is gone; these were its values.
template <class S> struct ParticleExpired {
  ParticleId particle;
  ParticleMaterialId material;
  Vec3<S> position;  // [m]
  Vec3<S> velocity;  // [m/s]

  ISO_FIELDS(particle, material, position, velocity)
};
/// A particle began to press on another particle or on scenery. Ascending by slots.
template <class S> struct ParticleContactBegin {
  ParticleId a, b;      // b null: the collider
  ColliderId collider;  // null: b
  S speed;              // [m/s] at which they closed

  ISO_FIELDS(a, b, collider, speed)
};

template <class S> struct ParticleEvents {
  std::vector<ParticleExpired<S>> expired;
  std::vector<ParticleContactBegin<S>> contact_begin;
  std::vector<SpringId> yielded;        // beyond their elastic limit: their rest length is another now
  std::vector<Vec3<S>> touch_impulses;  // [kg m/s] on what was touched, one a touch, in their order

  ISO_INLINE void clear() {
    expired.clear();
    contact_begin.clear();
    yielded.clear();
    touch_impulses.clear();
  }
};

/// The repairs of a step. They are identical on every peer.
struct ParticleReport {
  std::uint32_t clamped_speed = 0;     // particles whose speed was cut to ParticleLimits<S>
  std::uint32_t clamped_force = 0;     // particles pushed harder than limits.hpp allows, or than the format does
  std::uint32_t clamped_position = 0;  // particles held at the edge of the world
  std::uint32_t stopped = 0;           // particles put back and stopped because a number was not finite
  std::uint32_t unresolved = 0;        // constraints that worst_first left when its iterations were over
  std::uint32_t undivided = 0;         // sub-steps that time_division ended with contacts left to come
  std::uint32_t unsolved = 0;          // sub-steps whose implicit system had no solution: taken explicitly
  std::uint32_t lost_pairs = 0;  // searches for pairs that found more than settings allow: the rest was passed over
  std::uint32_t spent = 0;       // resolutions that ended in one plain pass: the step's looks were over
  ISO_INLINE constexpr bool clean() const {
    return clamped_speed == 0 && clamped_force == 0 && clamped_position == 0 && stopped == 0 && unresolved == 0 &&
           undivided == 0 && unsolved == 0 && lost_pairs == 0 && spent == 0;
  }
  ISO_FIELDS(clamped_speed, clamped_force, clamped_position, stopped, unresolved, undivided, unsolved, lost_pairs,
             spent)
};

}  // namespace isostep
