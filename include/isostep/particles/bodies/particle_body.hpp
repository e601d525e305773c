// ParticleBody: what a builder of mass-aggregate bodies made, by id; and what all builders share.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/particles/particle_world.hpp"

namespace isostep {

/// The ids that every `build` returns. A builder gives commands and remembers nothing: the ids are the caller's to
/// keep. At the first command that the world refuses it stops and takes back what it made; then all lists are empty and
/// `fault` is the world's reason, or bad_argument for counts that make no body.
struct ParticleBody {
  std::vector<ParticleId> particles;  // each body says in which order
  std::vector<SpringId> springs;
  std::vector<LinkId> links;
  ParticleMaterialId material;  // null but where the body has one of its own
  CohesionId cohesion;          // null but of blobs
  Fault fault = Fault::none;

  ISO_INLINE explicit operator bool() const { return fault == Fault::none; }
};

/// Destroys what is still there of a body, last made first, and empties its lists; its fault stays.
template <class S> void remove(ParticleWorld<S>& world, ParticleBody& body);

/// Springs of one kind in a cloth or a soft box. With a stiffness of 0 both numbers follow from the particles' mass m
/// and the world's sub-step h: k = s m / h^2 and c = s m / (4 h), with a share s that each kind of each body documents,
/// far enough below 1 that all springs of a particle together leave semi-implicit Euler stable:
///   the sum over its springs of 2 k h^2/m + 4 c h/m stays below 4 (Gershgorin's bound on the network's fastest mode).
/// At a finer rate such a body is stiffer. Fixed point: k and c end at the largest number, which only softens.
template <class S> struct SpringKind {
  bool present = true;
  S stiffness = S(0);  // [N/m]
  S damping = S(0);    // [N s/m]
};

/// Limits of a body, and of a row of it.
inline constexpr std::uint32_t kMostBodyParticles = 1u << 20, kMostBodyRow = 1u << 14;

#define ISO_PARTICLE_BODY_OF(extern, S) extern template void remove<S>(ParticleWorld<S>&, ParticleBody&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_BODY_OF)

}  // namespace isostep
