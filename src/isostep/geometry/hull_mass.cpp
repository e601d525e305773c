// Volume, centre and second moments of a convex hull.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_mass.hpp"

#include "isostep/scalar/wide_int.hpp"

namespace isostep {
namespace {

/// Sums over tetrahedra from a reference point to the triangles of the faces; d is six times the volume of one.
/// Magnitudes with edges below 2^20 steps: d sums to 2^62.6, the first moments to 2^84.2, the second to 2^106.2.
struct Moments {
  std::int64_t volume6;
  Int128 first[3];   // of d (a + b + c): 24 times the integral of x
  Int128 second[6];  // of d ((a + b + c)_i (a + b + c)_j + a_i a_j + b_i b_j + c_i c_j): 120 times that of x_i x_j
};

constexpr int kRows[6] = {0, 1, 2, 1, 2, 0}, kColumns[6] = {0, 1, 2, 2, 0, 1};  // xx yy zz yz zx xy

void add_tetrahedron(Moments& sum, const std::int64_t (&a)[3], const std::int64_t (&b)[3], const std::int64_t (&c)[3]) {
  const std::int64_t d =
      dot(cross(GridVector{a[0], a[1], a[2]}, GridVector{b[0], b[1], b[2]}), GridVector{c[0], c[1], c[2]});
  sum.volume6 += d;
  std::int64_t s[3];
  for (int i = 0; i < 3; ++i) {
    s[i] = a[i] + b[i] + c[i];
    sum.first[i] = sum.first[i] + Int128(d) * s[i];
  }
  for (int k = 0; k < 6; ++k) {
    const int i = kRows[k], j = kColumns[k];
    const std::int64_t weight = s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
    sum.second[k] = sum.second[k] + Int128(d) * weight;
  }
}

Moments moments_about(const ConvexHull& hull, GridPoint reference) {
  Moments sum = {0, {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
  const auto from_reference = [&](std::uint8_t half_edge, std::int64_t(&to)[3]) {
    const GridVector v = hull.vertices[hull.half_edges[half_edge].origin] - reference;
    to[0] = v.x, to[1] = v.y, to[2] = v.z;
  };
  std::int64_t a[3], b[3], c[3];
  for (const std::uint8_t first : hull.faces) {
    from_reference(first, a);
    std::uint8_t edge = hull.half_edges[first].next;
    for (std::uint8_t next = hull.half_edges[edge].next; next != first; next = hull.half_edges[next].next) {
      from_reference(edge, b);
      from_reference(next, c);
      add_tetrahedron(sum, a, b, c);
      edge = next;
    }
  }
  return sum;
}

/// The quotient to nearest, halves away from zero. `divisor` is positive, and the quotient below 2^63.
std::int64_t rounded_quotient(Int128 numerator, std::int64_t divisor) {
  const bool negative = numerator < Int128(0);
  const Int128 magnitude = (negative ? -numerator : numerator) + Int128(divisor / 2);
  const auto quotient =
      static_cast<std::int64_t>(divide(parts(magnitude), static_cast<std::uint64_t>(divisor)).quotient);
  return negative ? -quotient : quotient;
}

constexpr int kBits = HullMass::kFractionBits;

}  // namespace

HullMass hull_mass(const ConvexHull& hull) {
  HullMass mass = {};
  const GridPoint corner = hull.vertices[0];
  const std::int64_t origin[3] = {corner.x, corner.y, corner.z};
  Moments sum = moments_about(hull, corner);
  mass.volume6 = sum.volume6;
  std::int32_t near[3];  // the centre, to a step
  for (int i = 0; i < 3; ++i)
    near[i] = static_cast<std::int32_t>(origin[i] + rounded_quotient(sum.first[i], sum.volume6) / 4);
  // The squares of the means are below a few steps from there, and take no digits from the second moments.
  sum = moments_about(hull, {near[0], near[1], near[2]});
  std::int64_t mean[3];  // [2^-16 steps] four times the centre, from `near`
  for (int i = 0; i < 3; ++i) {
    mean[i] = rounded_quotient(sum.first[i] << kBits, sum.volume6);
    mass.centre[i] = static_cast<std::int64_t>(near[i]) * (1 << kBits) + mean[i] / 4;
  }
  for (int k = 0; k < 6; ++k) {
    const std::int64_t about_near = rounded_quotient(sum.second[k] << kBits, sum.volume6) / 20;
    const std::int64_t shift = (mean[kRows[k]] * mean[kColumns[k]] / 16) >> kBits;
    (k < 3 ? mass.variance[k] : mass.product[k - 3]) = about_near - shift;
  }
  return mass;
}

}  // namespace isostep
