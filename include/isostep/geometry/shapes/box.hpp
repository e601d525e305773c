// The box.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep {

namespace detail {
/// 3 / (x^2 + y^2), with both sides in units of the longer.
template <class S> ISO_INLINE S kappa_of_rectangle(S x, S y) {
  using U = Unit<S>;
  const S longer = max(x, y);
  const U ratio = divide_to<U>(min(x, y), longer);
  return quotient<S>(U(1.5), U(0.5) + U(0.5) * (ratio * ratio), longer);
}

/// Slabs, each mirrored so that the ray runs towards plus. The near face passed last is the one hit; ties go to the
/// lowest axis.
template <class S> ISO_INLINE LocalHit<S> cast_box(const LocalRay<S>& ray, Vec3<S> half) {
  const Vec3<S> o = abs(ray.origin);
  if (o.x <= half.x && o.y <= half.y && o.z <= half.z) return inside_hit<S>();
  S entry = S(0);
  S exit = ray.length;
  int face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Unit<S> u = abs(ray.direction[axis]);
    if (u == Unit<S>(0)) {
      if (o[axis] > half[axis]) return no_hit<S>();
      continue;
    }
    const S at = ray.direction[axis] < Unit<S>(0) ? -ray.origin[axis] : ray.origin[axis];
    const S nearby = divide_to<S>(-half[axis] - at, u);
    exit = min(exit, divide_to<S>(half[axis] - at, u));
    if (nearby > entry) {
      entry = nearby;
      face = axis;
    }
  }
  if (entry > exit) return no_hit<S>();
  Vec3<Unit<S>> normal = Vec3<Unit<S>>::zero();
  normal[face] = ray.direction[face] < Unit<S>(0) ? Unit<S>(1) : Unit<S>(-1);
  return {LocalHit<S>::entered, entry / ray.length, normal};
}
}  // namespace detail

/// Centre at the local origin, sides along the local axes.
template <class S = Literal> struct Box {
  static constexpr ShapeType kType = ShapeType::box;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = true;

  Vec3<S> half_extents;  // [m]

  static ISO_INLINE constexpr Box of(const Primitive<S>& p) { return {p.half}; }
  static ISO_INLINE constexpr Box of(const Box<Literal>& box) {
    const Vec3<Literal>& h = box.half_extents;
    return {{from_literal<S>(h.x), from_literal<S>(h.y), from_literal<S>(h.z)}};
  }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, half_extents, S(0), Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const {
    ShapeFault fault = ShapeFault::none;
    for (int axis = 0; axis < 3 && fault == ShapeFault::none; ++axis) fault = detail::fault_of_size(half_extents[axis]);
    return fault;
  }
  ISO_INLINE constexpr Box normalised() const { return *this; }
  ISO_INLINE constexpr Aabb<S> bounds(const Transform<S>& t) const {
    const Vec3<Unit<S>>(&rows)[3] = t.rotation.rows;
    const Vec3<S>& h = half_extents;
    return Aabb<S>::around(t.position, {dot(abs(rows[0]), h), dot(abs(rows[1]), h), dot(abs(rows[2]), h)});
  }

  ISO_INLINE S inner_radius() const { return min(half_extents.x, min(half_extents.y, half_extents.z)); }
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    const Vec3<S> h = half_extents - Vec3<S>{inset, inset, inset};
    for (int corner = 0; corner < 8; ++corner) {
      point(Vec3<S>{(corner & 4) != 0 ? h.x : -h.x, (corner & 2) != 0 ? h.y : -h.y, (corner & 1) != 0 ? h.z : -h.z});
    }
    return S(0);
  }

  ISO_INLINE Vec3<S> middle() const { return Vec3<S>::zero(); }
  ISO_INLINE Vec3<S> support(Vec3<Unit<S>> n) const {
    const Vec3<S>& h = half_extents;
    return {n.x < Unit<S>(0) ? -h.x : h.x, n.y < Unit<S>(0) ? -h.y : h.y, n.z < Unit<S>(0) ? -h.z : h.z};
  }
  /// Corners as visit_core() counts them.
  ISO_INLINE void find_face(Vec3<Unit<S>> n, Unit<S>, SolidFace<S>& face) const {
    const Vec3<Unit<S>> size = abs(n);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = axis < 2 ? axis + 1 : 0, v = axis < 1 ? 2 : axis - 1;
    const bool below = n[axis] < Unit<S>(0);
    face.normal = Vec3<Unit<S>>::zero();
    face.normal[axis] = below ? Unit<S>(-1) : Unit<S>(1);
    face.name = static_cast<std::uint32_t>(axis) << 1 | (below ? 1u : 0u);
    for (int k = 0; k < 4; ++k) {
      bool above[3] = {};
      above[axis] = !below, above[u] = k == 1 || k == 2, above[v] = k >= 2;
      face.add({above[0] ? half_extents.x : -half_extents.x, above[1] ? half_extents.y : -half_extents.y,
                above[2] ? half_extents.z : -half_extents.z},
               (above[0] ? 4u : 0u) | (above[1] ? 2u : 0u) | (above[2] ? 1u : 0u));
    }
  }

  ISO_INLINE S mass(S density) const {
    return detail::saturating_product<S>({density, S(8), half_extents.x, half_extents.y, half_extents.z});
  }
  ISO_INLINE Vec3<S> kappa() const {
    const Vec3<S>& h = half_extents;
    return {detail::kappa_of_rectangle(h.y, h.z), detail::kappa_of_rectangle(h.z, h.x),
            detail::kappa_of_rectangle(h.x, h.y)};
  }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    const Vec3<Unit<S>> h = relative_to(scale);
    return h.x * h.y * h.z;
  }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S scale) const {
    const Vec3<Unit<S>> h = relative_to(scale);
    const Unit<S> third = Unit<S>(1.0 / 3);
    return {third * (h.y * h.y + h.z * h.z), third * (h.z * h.z + h.x * h.x), third * (h.x * h.x + h.y * h.y)};
  }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return detail::cast_box(detail::LocalRay<S>::of(t, origin, translation), half_extents);
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    return detail::closest_on_core(half_extents, S(0), t, query);
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        Vec3<S> to = half_extents;
        if ((corner & 1) != 0) to[(axis + 1) % 3] = -to[(axis + 1) % 3];
        if ((corner & 2) != 0) to[(axis + 2) % 3] = -to[(axis + 2) % 3];
        Vec3<S> from = to;
        from[axis] = -from[axis];
        line(from, to);
      }
    }
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}  // its sizes say all
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }

 private:
  ISO_INLINE Vec3<Unit<S>> relative_to(S scale) const {
    using U = Unit<S>;
    const Vec3<S>& h = half_extents;
    return {divide_to<U>(h.x, scale), divide_to<U>(h.y, scale), divide_to<U>(h.z, scale)};
  }
};
Box(Vec3<Literal>)->Box<Literal>;

}  // namespace isostep
