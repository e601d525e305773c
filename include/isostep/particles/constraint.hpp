// Constraints for solvers: contacts and links as rows on the relative velocity of two particles.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

enum class ConstraintKind : std::uint32_t {
  contact,  // C >= 0 with friction
  cable,    // C >= 0
  rod       // C = 0
};

/// Symbols: C [m], how far the constraint is from its end: the gap of a contact, what a cable has left, a rod's excess
///          length. Its rate is n.(v_b - v_a), where a side that is no particle has surface_velocity: 0 but of touches.
///          An impulse is the change of relative velocity that it makes [m/s], so that masses appear only as the share
///          of it that each side gets: share_a + share_b = 1, and shares are m_b / (m_a + m_b) and m_a / (m_a + m_b).
///          A pinned particle, or kNoParticle, has share 0. An impulse j >= 0 along n pushes the sides apart:
///          v_a -= n j share_a, v_b += n j share_b.
template <class S> struct ParticleConstraint {
  ConstraintKind kind;
  std::uint32_t a, b;                  // slots; b may be kNoParticle
  Vec3<Unit<S>> normal;                // [1] n
  S separation;                        // [m] C at the positions of the last look
  S radius;                            // [m] both sides' of a contact; of a touch the gap at the step's start, negated
  std::uint32_t other;                 // the collider's slot of a contact with scenery, the link's slot; kNoParticle
  Unit<S> share_a, share_b;            // [1]
  S friction;                          // [1] of a contact
  S restitution;                       // [1]
  Vec3<Velocity<S>> surface_velocity;  // [m/s] of b, where that is no particle
  Vec3<Velocity<S>> surface_gain;      // [m/s] that it gains by itself in a sub-step
  Velocity<S> surface_moved;           // [m] along n since the step began
  Vec3<Velocity<S>> total;             // [m/s] all impulses of the step, where b is no particle
  Velocity<S> impulse;                 // [m/s] along n; >= 0 but of rods
  Vec3<Velocity<S>> friction_impulse;  // [m/s] across n
  std::uint32_t meets;                 // 1: its sides met in this sub-step ...
  Velocity<S> closing;                 // [m/s] ... as fast as this, before anything held them
  Velocity<S> shift;                   // [m/s] along n, by which the sub-step pushes an overlap apart
  Velocity<S> impulse_seen;            // [m/s] largest of the step
  Velocity<S> approach;                // [m/s] lowest n.(v_b - v_a) at which they met in the step, <= 0
  SumOf<Velocity<S>, Velocity<S>> work;  // [m^2/s^2] change of the square of its speed by the step's impulses

  ISO_FIELDS(kind, a, b, normal, separation, radius, other, share_a, share_b, friction, restitution, surface_velocity,
             surface_gain, surface_moved, total, impulse, friction_impulse, meets, closing, shift, impulse_seen,
             approach, work)
};

/// sqrt(v^2 + 2 g w) [m/s] of v >= 0: what forces that add g to a speed in a sub-step make of it on the way of w times
/// the sub-step; 0 where they stop it before. Above the format's end it is held there.
template <class S> ISO_INLINE Velocity<S> worked_speed(Velocity<S> v, Velocity<S> g, Velocity<S> w) {
  using V = Velocity<S>;
  const bool adds = (g < V(0)) == (w < V(0));
  const auto root_of = [](V x) ISO_INLINE_LAMBDA { return sqrt(x < V(0) ? saturating_subtract(V(0), x) : x); };
  const V root = saturate_to<V>(product(root_of(g), root_of(w)));
  const V part = saturating_add(root, root * V(0.41421356237309503));  // times the root of 2
  if (part == V(0)) return v;
  if (adds) return direction_of(v, part, V(0)).length;
  return part < v ? min(saturate_to<V>(product(sqrt(v - part), sqrt(saturating_add(v, part)))), v) : V(0);
}

}  // namespace isostep
