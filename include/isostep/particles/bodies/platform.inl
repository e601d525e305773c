// The builder of platforms.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/builder.inl"
#include "isostep/particles/bodies/platform.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {

template <class S> ParticleBody build(ParticleWorld<S>& world, const PlatformDefinition<S>& definition) {
  constexpr std::int32_t kPlaces[6][3] = {{0, 0, 1}, {0, 0, -1}, {-3, 2, 1}, {-3, 2, -1}, {4, 2, 1}, {4, 2, -1}};
  return pin_floats([&] {
    detail::BodyBuilder<S> builder(world);
    builder.demand_places({definition.foot});
    for (const auto& place : kPlaces) {
      const Vec3<S> at = definition.foot + Vec3<S>{S(place[0]), S(place[1]), S(place[2])};
      builder.particle(at, definition.mass, false, definition.material);
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
      for (std::uint32_t j = i + 1; j < 6; ++j) builder.link(LinkType::rod, i, j);
    }
    return builder.finish();
  });
}

}  // namespace isostep
