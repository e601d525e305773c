// The builder of cloths.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/builder.inl"
#include "isostep/particles/bodies/cloth.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

template <class S> bool pins_cloth_at(const ClothDefinition<S>& d, std::uint32_t row, std::uint32_t column) {
  const bool side = column == 0 || column == d.columns - 1;
  switch (d.pins) {
    case ClothPins::none: return false;
    case ClothPins::two_corners: return row == 0 && side;
    case ClothPins::four_corners: return (row == 0 || row == d.rows - 1) && side;
    case ClothPins::edge: return row == 0;
  }
  return false;
}

/// Springs from every particle to the one `right` columns and `below` rows further.
template <class S>
void weave(BodyBuilder<S>& builder, const ClothDefinition<S>& d, const SpringKind<S>& kind, std::uint32_t right,
           std::uint32_t below) {
  for (std::uint32_t r = 0; builder.good() && r + below < d.rows; ++r) {
    for (std::uint32_t c = 0; c + right < d.columns; ++c) {
      const std::size_t here = std::size_t{r} * d.columns + c;
      const std::size_t there = here + std::size_t{below} * d.columns + right;
      if (right == 0 || below == 0) {
        builder.spring(kind, here, there);
      } else {  // both diagonals of the cell
        builder.spring(kind, here, there);
        builder.spring(kind, here + right, there - right);
      }
    }
  }
}

}  // namespace detail

template <class S> ParticleBody build(ParticleWorld<S>& world, const ClothDefinition<S>& d) {
  return pin_floats([&] {
    detail::BodyBuilder<S> builder(world);
    builder.demand(2 <= d.columns && d.columns <= kMostBodyRow && 2 <= d.rows && d.rows <= kMostBodyRow &&
                   std::uint64_t{d.columns} * d.rows <= kMostBodyParticles && d.pins <= ClothPins::edge);
    builder.demand_places({d.corner, d.across, d.down});
    if (!builder.good()) return builder.finish();
    const S mass = d.mass / S(d.columns) / S(d.rows);
    for (std::uint32_t r = 0; builder.good() && r < d.rows; ++r) {
      const Vec3<S> first = detail::on_the_way(d.corner, d.corner + d.down, r, d.rows - 1);
      for (std::uint32_t c = 0; c < d.columns; ++c) {
        const Vec3<S> at = detail::on_the_way(first, first + d.across, c, d.columns - 1);
        builder.particle(at, mass, detail::pins_cloth_at(d, r, c), d.material);
      }
    }
    const SpringKind<S> structural = builder.resolve(d.structural, mass, S(0.125));
    const SpringKind<S> shear = builder.resolve(d.shear, mass, S(0.0625));
    const SpringKind<S> bend = builder.resolve(d.bend, mass, S(0.03125));
    detail::weave(builder, d, structural, 1, 0);
    detail::weave(builder, d, structural, 0, 1);
    detail::weave(builder, d, shear, 1, 1);
    detail::weave(builder, d, bend, 2, 0);
    detail::weave(builder, d, bend, 0, 2);
    return builder.finish();
  });
}

}  // namespace isostep
