// Bodies of surface_queries.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/geometry/baked/surface_queries.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/math/segment.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {
namespace detail {

/// Finds the stretch of a ray inside a box [m]. Returns false when it misses.
template <class S> ISO_INLINE bool clip_ray(const LocalRay<S>& ray, const Aabb<S>& box, S& entry, S& exit) {
  entry = S(0);
  exit = ray.length;
  for (int axis = 0; axis < 3; ++axis) {
    const Unit<S> u = ray.direction[axis];
    const Unit<S> rise = u < Unit<S>(0) ? -u : u;
    const S to_near = u < Unit<S>(0) ? ray.origin[axis] - box.high[axis] : box.low[axis] - ray.origin[axis];
    const S to_far = u < Unit<S>(0) ? ray.origin[axis] - box.low[axis] : box.high[axis] - ray.origin[axis];
    // A plane decides nothing else beyond the ray's length, and its distance may not fit S.
    if (to_far < S(0) || to_near > ray.length * rise) return false;
    if (to_near > entry * rise) entry = divide_to<S>(to_near, rise);
    if (to_far < exit * rise) exit = divide_to<S>(to_far, rise);
  }
  return entry <= exit;
}

/// A ray's way through a surface's box, on a grid that is the surface's times 2^bits. Components are below 2^29.
struct GridRay {
  GridVector from, way;
  int bits;

  ISO_INLINE GridVector on_grid(MeshPoint p) const {
    const std::int64_t scale = std::int64_t{1} << bits;
    return {p.x * scale - from.x, p.y * scale - from.y, p.z * scale - from.z};
  }
  /// Returns true if the way meets a box, by separating axes: the box's axes (as far as `distant` of 2^30 of the way),
  /// and the cross products of its edges with the way.
  ISO_INLINE bool meets(const MeshBox& box, std::int64_t distant) const {
    const std::int64_t scale = std::int64_t{1} << bits;
    const std::int64_t at[3] = {from.x, from.y, from.z}, to[3] = {way.x, way.y, way.z};
    std::int64_t centre[3], half[3];  // doubled
    for (int i = 0; i < 3; ++i) {
      const std::int64_t low = box.low[i] * scale - at[i] - 2, high = box.high[i] * scale - at[i] + 2;
      const std::int64_t end = ((to[i] * ((distant >> 15) + 1)) >> 15) + (to[i] < 0 ? -1 : 1) * 2;
      if ((to[i] < 0 ? end : 0) > high || (to[i] < 0 ? 0 : end) < low) return false;
      centre[i] = low + high;
      half[i] = high - low;
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const std::int64_t gap = centre[j] * to[k] - centre[k] * to[j];
      const std::int64_t reach = half[j] * (to[k] < 0 ? -to[k] : to[k]) + half[k] * (to[j] < 0 ? -to[j] : to[j]);
      if ((gap < 0 ? -gap : gap) > reach) return false;
    }
    return true;
  }
  struct Entry {
    std::int64_t at;  // in 2^-30 of the way; negative: the way does not pass it
    bool from_behind;
  };
  /// Finds where the way passes a triangle from its outward side, or from both sides with `back_faces`.
  ISO_INLINE Entry enter(const TriangleCorners& triangle, bool back_faces) const {
    constexpr Entry kMissed = {-1, false};
    const GridVector p[3] = {on_grid(triangle.points[0]), on_grid(triangle.points[1]), on_grid(triangle.points[2])};
    const Int128 sides[3] = {wide_dot(cross(p[0], p[1]), way), wide_dot(cross(p[1], p[2]), way),
                             wide_dot(cross(p[2], p[0]), way)};
    const Int128 sum = sides[0] + sides[1] + sides[2];
    const bool behind = sum > Int128(0);
    if (sum == Int128(0) || (behind && !back_faces)) return kMissed;
    for (const Int128& side : sides) {
      if (behind ? side < Int128(0) : side > Int128(0)) return kMissed;
    }
    const GridVector e = {p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z},
                     f = {p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z};
    const Int128 height = wide_dot(cross(e, f), p[0]);
    const Int128 fall = behind ? sum : -sum, start = behind ? height : -height;
    if (start < Int128(0) || start > fall) return kMissed;
    const UInt128Parts n = parts(start), d = parts(fall);
    const int right = d.high == 0 ? 0 : static_cast<int>(std::bit_width(d.high));
    const auto shifted = [right](UInt128Parts v) ISO_INLINE_LAMBDA {
      return right == 0 ? v.low : (v.low >> right) | (v.high << (64 - right));
    };
    const std::uint64_t divisor = shifted(d), numerator = shifted(n);
    return {static_cast<std::int64_t>(divide({numerator >> 34, numerator << 30}, divisor).quotient), behind};
  }
};

template <class G, class S> ISO_INLINE GridRay grid_ray(const G& surface, const LocalRay<S>& ray, S entry, S exit) {
  const MeshBox box = surface.bounds();
  std::int64_t most = 1;
  for (int axis = 0; axis < 3; ++axis) {
    most = max(most, max(-box.low[axis], box.high[axis]));
  }
  GridRay grid;
  grid.bits = min(26 - static_cast<int>(std::bit_width(static_cast<std::uint64_t>(most))) + 1, 16);
  const auto steps = [&](Vec3<S> p) ISO_INLINE_LAMBDA {
    const int exponent = surface.exponent() + grid.bits;
    return GridVector{floor_scaled(p.x, exponent), floor_scaled(p.y, exponent), floor_scaled(p.z, exponent)};
  };
  grid.from = steps(ray.origin + ray.direction * entry);
  const GridVector to = steps(ray.origin + ray.direction * exit);
  grid.way = {to.x - grid.from.x, to.y - grid.from.y, to.z - grid.from.z};
  return grid;
}

/// The nearest point of a triangle.
template <class S> ISO_INLINE Vec3<S> nearest_on_triangle(const Vec3<S> (&p)[3], Vec3<Unit<S>> normal, Vec3<S> query) {
  bool above = true;
  Vec3<S> best = p[0];
  S least = highest<S>();
  for (int k = 0; k < 3; ++k) {
    const Heading<S> way = heading_of(p[(k + 1) % 3] - p[k]);
    const Vec3<S> apart = query - p[k];
    if (dot(cross(normal, way.direction), apart) >= S(0)) continue;
    above = false;
    const Vec3<S> on_edge = p[k] + way.direction * clamp(dot(way.direction, apart), S(0), way.length);
    const S distance = length(query - on_edge);
    if (distance < least) least = distance, best = on_edge;
  }
  return above ? query - normal * dot(normal, query - p[0]) : best;
}

}  // namespace detail

template <class G, class S> Aabb<S> box_of_surface(const G& surface) {
  const MeshBox box = surface.bounds();
  Aabb<S> result;
  for (int axis = 0; axis < 3; ++axis) {
    result.low[axis] = from_lattice<S>(box.low[axis], surface.exponent());
    result.high[axis] = from_lattice<S>(box.high[axis], surface.exponent());
  }
  return result;
}

namespace detail {

/// A ray and a surface, on the grid that they share.
template <class G, class S> class SurfaceCrossing {
  static constexpr std::int64_t kWhole = std::int64_t{1} << 30;

 public:
  ISO_INLINE SurfaceCrossing(const G& surface, const LocalRay<S>& ray) : surface_(surface), ray_(ray) {
    const Aabb<S> box = box_of_surface<G, S>(surface);
    const S slack = gap_noise(max(max_abs(box.low), max_abs(box.high)) + max_abs(ray.origin));
    meets_ = clip_ray(ray, grow(box, slack + from_lattice<S>(1, surface.exponent())), entry_, exit_);
    if (meets_) grid_ = grid_ray(surface, ray, entry_, exit_);
  }

  /// Returns the first hit by fraction, then by id. Places are finer than fractions: the nearest alone is not enough.
  ISO_INLINE LocalHit<S> first(const RayReach<S>& reach) const {
    std::int64_t most = most_of(reach.max_fraction), alike = -1;
    std::uint32_t triangle = kNoTriangle;
    GridRay::Entry best = {};
    S least = S(1);
    visit(reach.back_faces, most, [&](std::uint32_t id, GridRay::Entry entry) ISO_INLINE_LAMBDA {
      const S fraction = fraction_of(entry.at);
      if (triangle != kNoTriangle && (fraction > least || (fraction == least && id > triangle))) return;
      triangle = id, best = entry, least = fraction;
      if (alike < 0) alike = most_alike();
      most = min(most, entry.at + alike);
    });
    return triangle == kNoTriangle ? no_hit<S>() : hit_of(triangle, best);
  }
  ISO_INLINE void all(const RayReach<S>& reach, const RayTaker<S>& taker) const {
    const std::int64_t most = most_of(reach.max_fraction);
    visit(reach.back_faces, most, [&](std::uint32_t id, GridRay::Entry entry) ISO_INLINE_LAMBDA {
      const LocalHit<S> hit = hit_of(id, entry);
      if (hit.fraction <= reach.max_fraction) taker.take(taker.user, hit);
    });
  }

 private:
  /// Visits the triangles entered by `most`, which may shrink on the way, in general the nearest first.
  template <class Visit> ISO_INLINE void visit(bool back_faces, const std::int64_t& most, const Visit& found) const {
    if (!meets_ || most < 0) return;
    surface_.traverse(
        grid_.way, [&](const MeshBox& box) ISO_INLINE_LAMBDA { return grid_.meets(box, most); },
        [&](std::uint32_t id) ISO_INLINE_LAMBDA {
          const GridRay::Entry entry = grid_.enter(surface_.corners(id), back_faces);
          if (entry.at >= 0 && entry.at <= most) found(id, entry);
          return true;
        });
  }
  ISO_INLINE S fraction_of(std::int64_t at) const {
    return min((entry_ + (exit_ - entry_) * from_lattice<Unit<S>>(at, 30)) / ray_.length, S(1));
  }
  /// Returns a bound of the places whose fraction is at most max_fraction. Fractions ascend with places: one check.
  ISO_INLINE std::int64_t most_of(S max_fraction) const {
    if (!meets_ || !(max_fraction < S(1)) || !(ray_.length > S(0))) return kWhole;
    if (fraction_of(0) > max_fraction) return -1;
    const S part = max_fraction * ray_.length + noise_of_fractions() - entry_, whole = exit_ - entry_;
    if (!(part < whole) || !(part > S(0))) return kWhole;
    const std::int64_t guess = min(floor_scaled(divide_to<Unit<S>>(part, whole), 30) + 1, kWhole);
    return fraction_of(guess) > max_fraction ? guess : kWhole;
  }
  /// [m] The distance beyond which two places have different fractions.
  ISO_INLINE S noise_of_fractions() const { return gap_noise(ray_.length) + resolution<S>() * ray_.length; }
  /// Returns an upper bound of the places that may have one fraction.
  ISO_INLINE std::int64_t most_alike() const {
    const S whole = exit_ - entry_, noise = noise_of_fractions();
    return noise < whole ? floor_scaled(divide_to<Unit<S>>(noise, whole), 30) + 1 : kWhole;
  }
  ISO_INLINE LocalHit<S> hit_of(std::uint32_t id, GridRay::Entry entry) const {
    const BakedTriangle baked = surface_.triangle(id);
    const Vec3<Unit<S>> normal = unit_of_steps<Unit<S>>(baked.normal());
    return {LocalHit<S>::entered, fraction_of(entry.at), entry.from_behind ? -normal : normal, id, baked.material};
  }

  const G& surface_;
  const LocalRay<S>& ray_;
  S entry_, exit_;  // [m] of the stretch inside the surface's box
  bool meets_;
  GridRay grid_;
};

}  // namespace detail

template <class G, class S>
detail::LocalHit<S> cast_on_surface(const G& surface, const detail::LocalRay<S>& ray, const RayReach<S>& reach) {
  return detail::SurfaceCrossing<G, S>(surface, ray).first(reach);
}
template <class G, class S>
void cast_through_surface(const G& surface, const detail::LocalRay<S>& ray, const RayReach<S>& reach,
                          const RayTaker<S>& taker) {
  detail::SurfaceCrossing<G, S>(surface, ray).all(reach, taker);
}

template <class G, class S> ClosestPoint<S> nearest_on_surface(const G& surface, Vec3<S> query) {
  const int exponent = surface.exponent();
  ClosestPoint<S> best = {query, highest<S>(), Vec3<Unit<S>>::zero()};
  std::uint32_t triangle = kNoTriangle;
  const auto overlaps = [&](const MeshBox& of) ISO_INLINE_LAMBDA {
    Vec3<S> gap;
    for (int axis = 0; axis < 3; ++axis) {
      gap[axis] = max(max(from_lattice<S>(of.low[axis], exponent) - query[axis],
                          query[axis] - from_lattice<S>(of.high[axis], exponent)),
                      S(0));
    }
    return triangle == kNoTriangle || length(gap) <= best.distance + detail::gap_noise(max_abs(query));
  };
  surface.traverse(overlaps, [&](std::uint32_t id) ISO_INLINE_LAMBDA {
    const BakedTriangle baked = surface.triangle(id);
    const Vec3<Unit<S>> outward = detail::unit_of_steps<Unit<S>>(baked.normal());
    Vec3<S> points[3];
    for (int i = 0; i < 3; ++i) points[i] = detail::point_of_steps<S>(baked.points[i], exponent);
    const Vec3<S> on = detail::nearest_on_triangle(points, outward, query);
    const Heading<S> way = heading_of(query - on);
    if (triangle != kNoTriangle && !(way.length < best.distance || (way.length == best.distance && id < triangle)))
      return true;
    triangle = id;
    best = {on, way.length, way.length > S(0) ? way.direction : outward};
    return true;
  });
  return best;
}

}  // namespace isostep
