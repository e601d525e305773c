// A polyhedron thickened by a radius: where a ray enters it, and how it is drawn.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/geometry/ray.hpp"

namespace isostep {

/// Finds where a ray enters the points within `radius` > 0 of a polyhedron, in its frame; a ray that starts inside is
/// reported as `inside`. Their surface is the faces, moved outward, and parts of the cylinders around the edges and of
/// the balls around the vertices: the first of those that the ray enters is exact to rounding, without a search.
template <class S>
detail::LocalHit<S> cast_rounded(const Polyhedron<S>& solid, S radius, const detail::LocalRay<S>& ray);

#define ISO_ROUNDED_POLYHEDRON_OF(extern, S) \
  extern template detail::LocalHit<S> cast_rounded<S>(const Polyhedron<S>&, S, const detail::LocalRay<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROUNDED_POLYHEDRON_OF)

namespace detail {

/// A drawing of the faces moved outward by the radius; quarters of the arcs that join them across each edge; around
/// each vertex the ends of its edges' arcs, as a fan about the mean of its faces' normals. Chords of round parts lie
/// inside of them.
template <class S> class RoundedDrawing {
  using U = Unit<S>;
  static constexpr int kArc = 4;  // chords

 public:
  ISO_INLINE RoundedDrawing(const Polyhedron<S>& solid, S radius) : solid_(solid), radius_(radius) {}

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    for (std::uint32_t k = 0; k < solid_.edges(); ++k) {
      const Arc arc = arc_of(k);
      const Vec3<S> from = solid_.vertices[solid_.origin(2 * k)], to = solid_.vertices[solid_.origin(2 * k + 1)];
      line(from + arc.out[0], to + arc.out[0]);
      line(from + arc.out[kArc], to + arc.out[kArc]);
      for (int i = 0; i < kArc; ++i) {
        line(from + arc.out[i], from + arc.out[i + 1]);
        line(to + arc.out[i], to + arc.out[i + 1]);
      }
    }
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle& triangle) const {
    for (std::uint32_t f = 0; f < solid_.faces.size(); ++f) visit_face(f, triangle);
    for (std::uint32_t k = 0; k < solid_.edges(); ++k) {
      const Arc arc = arc_of(k);
      const std::uint32_t ends[2] = {solid_.origin(2 * k), solid_.origin(2 * k + 1)};
      const Vec3<S> from = solid_.vertices[ends[0]], to = solid_.vertices[ends[1]];
      const Vec3<S> low = from + middle_of(ends[0]), high = to + middle_of(ends[1]);
      for (int i = 0; i < kArc; ++i) {  // from the left face to the right
        const Vec3<S> left = arc.out[i], right = arc.out[i + 1];
        triangle(from + right, to + right, to + left);
        triangle(from + right, to + left, from + left);
        triangle(low, from + right, from + left);
        triangle(high, to + left, to + right);
      }
    }
  }

 private:
  struct Arc {
    Vec3<S> out[kArc + 1];
  };  // [m] from the edge to the surface, from its left face to its right

  static ISO_INLINE Vec3<U> between(Vec3<U> a, Vec3<U> b) { return normalise(a * U(0.5) + b * U(0.5)); }
  ISO_INLINE Arc arc_of(std::uint32_t k) const {
    const Vec3<U> left = solid_.normals[solid_.half_edges[2 * k].face];
    const Vec3<U> right = solid_.normals[solid_.half_edges[2 * k + 1].face], middle = between(left, right);
    return {{left * radius_, between(left, middle) * radius_, middle * radius_, between(middle, right) * radius_,
             right * radius_}};
  }
  ISO_INLINE Vec3<S> middle_of(std::uint32_t vertex) const {
    const U share = divide_to<U>(S(1), S(static_cast<std::int32_t>(solid_.faces.size())));
    Vec3<U> sum = Vec3<U>::zero();
    solid_.visit_spokes(vertex, [&](std::uint32_t half_edge) ISO_INLINE_LAMBDA {
      sum += solid_.normals[solid_.half_edges[half_edge].face] * share;
    });
    return normalise(sum) * radius_;
  }
  template <class Triangle> ISO_INLINE void visit_face(std::uint32_t f, const Triangle& triangle) const {
    const Vec3<S> out = solid_.normals[f] * radius_;
    solid_.visit_fan(f, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) ISO_INLINE_LAMBDA {
      triangle(solid_.vertices[i] + out, solid_.vertices[j] + out, solid_.vertices[k] + out);
    });
  }

  Polyhedron<S> solid_;
  S radius_;  // [m]
};

}  // namespace detail
}  // namespace isostep
