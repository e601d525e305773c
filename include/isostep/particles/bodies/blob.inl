// The builder of blobs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/blob.hpp"
#include "isostep/particles/bodies/builder.inl"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

/// Side of the smallest square or cube with room for `count`.
ISO_INLINE std::uint32_t side_of(std::uint32_t count, bool flat) {
  std::uint64_t side = 1;
  while (side * side * (flat ? 1 : side) < count) ++side;
  return static_cast<std::uint32_t>(side);
}

}  // namespace detail

template <class S> ParticleBody build(ParticleWorld<S>& world, const BlobDefinition<S>& d) {
  return pin_floats([&] {
    detail::BodyBuilder<S> builder(world);
    builder.demand(1 <= d.particles && d.particles <= kMostBodyParticles);
    builder.demand_places({d.centre});
    if (!builder.good()) return builder.finish();
    const ParticleMaterialId material = builder.material(d.material);
    Cohesion<S> cohesion;
    cohesion.material = material;
    cohesion.repel_distance = d.repel_distance;
    cohesion.repel_force = d.repel_force;
    cohesion.attract_start = d.attract_start;
    cohesion.attract_end = d.attract_end;
    cohesion.attract_force = d.attract_force;
    builder.cohesion(cohesion);
    const std::uint32_t side = detail::side_of(d.particles, d.flat);
    const S edge = saturate_to<S>(product(d.spacing, S(side - 1))) * S(0.5);
    const Vec3<S> low = d.centre - Vec3<S>{edge, edge, d.flat ? S(0) : edge};
    for (std::uint32_t i = 0; builder.good() && i < d.particles; ++i) {
      const Vec3<S> cell = {S(i % side), S(i / side % side), S(d.flat ? 0 : i / side / side)};
      builder.particle(low + cell * d.spacing, d.mass, false, material);
    }
    return builder.finish();
  });
}

}  // namespace isostep
