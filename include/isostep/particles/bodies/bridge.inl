// The builder of bridges.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/bridge.hpp"
#include "isostep/particles/bodies/builder.inl"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

/// Particle i of two rows with `columns` columns about a centre.
template <class S> Vec3<S> bridge_point(Vec3<S> centre, std::uint32_t columns, S spacing, S width, std::uint32_t i) {
  const auto twice = static_cast<std::int32_t>(2 * (i / 2)) - static_cast<std::int32_t>(columns - 1);
  return centre +
         Vec3<S>{saturate_to<S>(product(spacing, S(twice))) * S(0.5), S(0), width * (i % 2 == 0 ? S(-0.5) : S(0.5))};
}

template <class S> Link<S> bridge_support(const BridgeDefinition<S>& d, std::uint32_t i, ParticleId particle) {
  const Vec3<S> middle = d.centre + Vec3<S>{S(0), d.support_height, S(0)};
  const std::uint32_t column = i / 2, from_end = d.columns - 1 - column;
  Link<S> link;
  link.a = particle;
  link.anchor = bridge_point(middle, d.columns, d.support_spacing, d.support_width, i);
  link.length = d.support_length + d.support_growth * S(column < from_end ? column : from_end);
  link.restitution = d.support_restitution;
  return link;
}

}  // namespace detail

template <class S> ParticleBody build(ParticleWorld<S>& world, const BridgeDefinition<S>& d) {
  return pin_floats([&] {
    detail::BodyBuilder<S> builder(world);
    const std::uint32_t count = 2 * d.columns;
    builder.demand(2 <= d.columns && d.columns <= kMostBodyRow && S(0) < d.deck_length && S(0) < d.width);
    builder.demand_places({d.centre, {S(0), d.support_height, S(0)}});
    if (!builder.good()) return builder.finish();
    for (std::uint32_t i = 0; builder.good() && i < count; ++i) {
      builder.particle(detail::bridge_point(d.centre, d.columns, d.spacing, d.width, i), d.mass, false, d.material);
    }
    for (std::uint32_t i = 0; builder.good() && i + 2 < count; ++i) {
      builder.link(LinkType::cable, i, i + 2, d.deck_length, d.deck_restitution);
    }
    for (std::uint32_t i = 0; builder.good() && i < count; ++i) {
      builder.link(detail::bridge_support(d, i, builder.particle(i)));
    }
    for (std::uint32_t i = 0; builder.good() && i < count; i += 2) builder.link(LinkType::rod, i, i + 1, d.width);
    return builder.finish();
  });
}

}  // namespace isostep
