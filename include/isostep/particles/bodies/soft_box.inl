// The builder of soft boxes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/builder.inl"
#include "isostep/particles/bodies/soft_box.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

/// Half of a particle's 26 neighbours: those that come after it.
inline constexpr std::int32_t kLaterNeighbours[13][3] = {{1, 0, 0},  {-1, 1, 0}, {0, 1, 0},  {1, 1, 0}, {-1, -1, 1},
                                                         {0, -1, 1}, {1, -1, 1}, {-1, 0, 1}, {0, 0, 1}, {1, 0, 1},
                                                         {-1, 1, 1}, {0, 1, 1},  {1, 1, 1}};

/// The place of a neighbour along an axis; `count` or more: there is none.
ISO_INLINE std::uint32_t beside(std::uint32_t place, std::int32_t offset) {
  return place + static_cast<std::uint32_t>(offset);
}

template <class S> class SoftBoxBuilder {
 public:
  SoftBoxBuilder(BodyBuilder<S>& builder, const SoftBoxDefinition<S>& definition, S mass)
      : builder_(builder),
        d_(definition),
        mass_(mass),
        kinds_{builder.resolve(definition.structural, mass, S(0.0625)),
               builder.resolve(definition.face, mass, S(0.03125)),
               builder.resolve(definition.space, mass, S(0.03125))} {}

  void place(std::uint32_t c, std::uint32_t r, std::uint32_t l) {
    const Vec3<S> low = d_.centre - d_.size * S(0.5), high = d_.centre + d_.size * S(0.5);
    const Vec3<S> at = {on_the_way(low, high, c, d_.columns - 1).x, on_the_way(low, high, r, d_.rows - 1).y,
                        on_the_way(low, high, l, d_.layers - 1).z};
    builder_.particle(at, mass_, false, d_.material);
  }
  void tie(std::uint32_t c, std::uint32_t r, std::uint32_t l) {
    for (const auto& n : kLaterNeighbours) {
      const std::uint32_t column = beside(c, n[0]), row = beside(r, n[1]), layer = beside(l, n[2]);
      if (column >= d_.columns || row >= d_.rows || layer >= d_.layers) continue;
      const int axes = (n[0] != 0) + (n[1] != 0) + (n[2] != 0);
      builder_.spring(kinds_[axes - 1], index(c, r, l), index(column, row, layer));
    }
  }
  template <class Visit> void for_each(Visit&& visit) {
    for (std::uint32_t l = 0; builder_.good() && l < d_.layers; ++l) {
      for (std::uint32_t r = 0; r < d_.rows; ++r) {
        for (std::uint32_t c = 0; c < d_.columns; ++c) visit(c, r, l);
      }
    }
  }

 private:
  std::size_t index(std::uint32_t c, std::uint32_t r, std::uint32_t l) const {
    return (std::size_t{l} * d_.rows + r) * d_.columns + c;
  }

  BodyBuilder<S>& builder_;
  const SoftBoxDefinition<S>& d_;
  S mass_;
  SpringKind<S> kinds_[3];
};

}  // namespace detail

template <class S> ParticleBody build(ParticleWorld<S>& world, const SoftBoxDefinition<S>& d) {
  return pin_floats([&] {
    detail::BodyBuilder<S> builder(world);
    for (const std::uint32_t count : {d.columns, d.rows, d.layers}) builder.demand(2 <= count && count <= kMostBodyRow);
    builder.demand(std::uint64_t{d.columns} * d.rows <= kMostBodyParticles &&
                   std::uint64_t{d.columns} * d.rows * d.layers <= kMostBodyParticles);
    builder.demand_places({d.centre, d.size});
    if (!builder.good()) return builder.finish();
    const S mass = d.mass / S(d.columns) / S(d.rows) / S(d.layers);
    detail::SoftBoxBuilder<S> box(builder, d, mass);
    box.for_each([&](std::uint32_t c, std::uint32_t r, std::uint32_t l) ISO_INLINE_LAMBDA { box.place(c, r, l); });
    box.for_each([&](std::uint32_t c, std::uint32_t r, std::uint32_t l) ISO_INLINE_LAMBDA { box.tie(c, r, l); });
    return builder.finish();
  });
}

}  // namespace isostep
