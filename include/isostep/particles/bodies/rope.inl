// The builder of ropes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/builder.inl"
#include "isostep/particles/bodies/rope.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {

template <class S> ParticleBody build(ParticleWorld<S>& world, const RopeDefinition<S>& definition) {
  return pin_floats([&] {
    detail::BodyBuilder<S> builder(world);
    const std::uint32_t count = definition.particles, last = count - 1;
    builder.demand(2 <= count && count <= kMostBodyRow);
    builder.demand_places({definition.start, definition.end});
    if (!builder.good()) return builder.finish();
    const S mass = definition.mass / S(count);
    for (std::uint32_t i = 0; builder.good() && i < count; ++i) {
      const bool pinned = (i == 0 && definition.pin_start) || (i == last && definition.pin_end);
      const Vec3<S> at = detail::on_the_way(definition.start, definition.end, i, last);
      builder.particle(at, mass, pinned, definition.material);
    }
    const S whole = definition.length == S(0) ? distance(definition.start, definition.end) : definition.length;
    const S length = whole / S(last);
    for (std::uint32_t i = 0; builder.good() && i < last; ++i) {
      builder.link(definition.type, i, i + 1, length, definition.restitution);
    }
    return builder.finish();
  });
}

}  // namespace isostep
