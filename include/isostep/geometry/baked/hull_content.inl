// Bodies of hull_content.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/hull_content.hpp"
#include "isostep/geometry/baked/hull_mass.hpp"
#include "isostep/geometry/baked/polyhedron.inl"
#include "isostep/geometry/limits.hpp"

namespace isostep {

namespace detail {
/// numerator / divisor, whose magnitude is at most 1; |numerator| < 2^65, divisor > 0.
template <class U> ISO_INLINE U ratio_of(Int128 numerator, std::uint64_t divisor) {
  constexpr int kBits = 61;
  const bool negative = numerator < Int128(0);
  const Int128 scaled = (negative ? -numerator : numerator) << kBits;
  const auto quotient = static_cast<std::int64_t>(divide(parts(scaled), divisor).quotient);
  return from_lattice<U>(negative ? -quotient : quotient, kBits);
}

/// The box of a hull's vertices on the grid.
struct GridBox {
  std::int64_t low[3], width[3];  // [steps]

  ISO_INLINE explicit GridBox(const ConvexHull& hull) {
    std::int64_t high[3];
    for (int i = 0; i < 3; ++i) low[i] = GridPoint::kLimit, high[i] = -GridPoint::kLimit;
    for (const GridPoint p : hull.vertices) {
      const std::int64_t at[3] = {p.x, p.y, p.z};
      for (int i = 0; i < 3; ++i) low[i] = min(low[i], at[i]), high[i] = max(high[i], at[i]);
    }
    for (int i = 0; i < 3; ++i) width[i] = high[i] - low[i];
  }
};

template <class S> ISO_INLINE ShapeFault fault_of_box(const GridBox& box, int exponent) {
  for (int i = 0; i < 3; ++i) {
    const std::int64_t extent = floor_scaled(Limits<S>::extent(), exponent);
    if (-box.low[i] > extent || box.low[i] + box.width[i] > extent) return ShapeFault::size_too_large;
    if (box.width[i] < 2 * floor_scaled(Limits<S>::minimum_size(), exponent)) return ShapeFault::size_too_small;
  }
  return ShapeFault::none;
}
}  // namespace detail

template <class S> std::shared_ptr<const void> HullContent<S>::make(Bytes bytes) {
  using U = Unit<S>;
  const auto content = std::make_shared<HullContent<S>>();
  const Result<GridHull> read = read_hull(bytes);
  if (!read.ok()) {
    content->fault = ShapeFault::blob_not_valid;
    return content;
  }
  const int exponent = read.value().exponent;
  const ConvexHull& hull = read.value().hull;
  const detail::GridBox box(hull);
  content->fault = detail::fault_of_box<S>(box, exponent);
  if (content->fault != ShapeFault::none) return content;
  content->solid = HullSolid<S>(hull, exponent);
  std::int64_t widest = 0;
  for (int i = 0; i < 3; ++i) {
    content->widths[i] = from_lattice<S>(box.width[i], exponent);
    widest = max(widest, box.width[i]);
  }
  content->half_width = from_lattice<S>(widest, exponent + 1);
  const HullMass mass = hull_mass(hull);
  const auto volume6 = static_cast<std::uint64_t>(6 * box.width[0] * box.width[1] * box.width[2]);
  content->filled = detail::ratio_of<U>(Int128(mass.volume6), volume6);
  constexpr int kBits = HullMass::kFractionBits;
  for (int i = 0; i < 3; ++i) content->centre_of_mass[i] = from_lattice<S>(mass.centre[i], exponent + kBits);
  const auto relative = [&](std::int64_t moment) ISO_INLINE_LAMBDA {  // over half the width, squared
    return detail::ratio_of<U>(Int128(moment) * 4, static_cast<std::uint64_t>(widest * widest) << kBits);
  };
  const std::int64_t xx = mass.variance[0], yy = mass.variance[1], zz = mass.variance[2];
  const U yz = -relative(mass.product[0]), zx = -relative(mass.product[1]), xy = -relative(mass.product[2]);
  content->inertia = {{{relative(yy) + relative(zz), xy, zx},
                       {xy, relative(zz) + relative(xx), yz},
                       {zx, yz, relative(xx) + relative(yy)}}};
  const auto in_box = [&](std::int64_t moment, int i, int j) ISO_INLINE_LAMBDA {
    return detail::ratio_of<U>(Int128(moment) * 4, static_cast<std::uint64_t>(box.width[i] * box.width[j]) << kBits);
  };
  content->variance = {in_box(xx, 0, 0), in_box(yy, 1, 1), in_box(zz, 2, 2)};
  content->product = {in_box(mass.product[0], 1, 2), in_box(mass.product[1], 2, 0), in_box(mass.product[2], 0, 1)};
  return content;
}

}  // namespace isostep
