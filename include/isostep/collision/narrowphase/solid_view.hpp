// SolidView<S>: a convex solid of any shape, or a triangle, as the pairs of all solids ask it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep::detail {

/// The calls of a solid's file, in the solid's own frame. `of` is the object of a view. Supports are in the finer
/// format, in which a direction across a short edge still has digits.
template <class S> struct SolidCalls {
  using F = Finer<S>;
  Vec3<F> (*support)(const void* of, Vec3<Unit<F>> n);
  ClosestPoint<S> (*closest)(const void* of, Vec3<S> p);
  void (*find_face)(const void* of, Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face);
};

template <class S> class SolidView {
  using F = Finer<S>;

 public:
  ISO_INLINE SolidView(const SolidCalls<S>& calls, const void* of, S around_core, S inner_radius, Vec3<S> middle_of_it)
      : radius(around_core), inner(inner_radius), middle(middle_of_it), calls_(calls), of_(of) {}

  /// [m] Returns the support point of the core along n.
  ISO_INLINE Vec3<F> support(Vec3<Unit<F>> n) const { return calls_.support(of_, n); }
  /// Returns the closest point of the core. Its distance is negative inside.
  ISO_INLINE ClosestPoint<S> closest(Vec3<S> p) const {
    ClosestPoint<S> found = calls_.closest(of_, p);
    found.point -= found.normal * radius;
    found.distance += radius;
    return found;
  }
  ISO_INLINE void find_face(Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) const {
    face.count = 0;
    face.is_disc = false;
    calls_.find_face(of_, n, flat, face);
  }

  S radius;        // [m] around the core
  S inner;         // [m] of a ball in the whole
  Vec3<S> middle;  // [m] well inside

 private:
  const SolidCalls<S>& calls_;
  const void* of_;
};

template <class S> ISO_INLINE Primitive<Finer<S>> finer_of(const Primitive<S>& p) {
  using F = Finer<S>;
  return {p.type, p.blob, finer_of<F>(p.half), finer<F>(p.radius), finer_of<Unit<F>>(p.normal), finer<F>(p.offset)};
}
template <template <class> class Shape, class S>
Vec3<Finer<S>> support_of_shape(const void* of, Vec3<Unit<Finer<S>>> n) {
  using F = Finer<S>;
  const ShapeView<S>& view = *static_cast<const ShapeView<S>*>(of);
  if constexpr (Shape<S>::kHasBlob) return finer_of<F>(shape_as<Shape>(view).support(coarser_of<Unit<S>>(n)));
  else return Shape<F>::of(finer_of(view.primitive)).support(n);
}
template <template <class> class Shape, class S> ClosestPoint<S> closest_of_shape(const void* of, Vec3<S> p) {
  const Transform<S> here = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
  return shape_as<Shape>(*static_cast<const ShapeView<S>*>(of)).closest(here, p);
}
template <template <class> class Shape, class S>
void find_face_of_shape(const void* of, Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) {
  shape_as<Shape>(*static_cast<const ShapeView<S>*>(of)).find_face(n, flat, face);
}
template <template <class> class Shape, class S>
inline constexpr SolidCalls<S> kSolidCalls = {support_of_shape<Shape, S>, closest_of_shape<Shape, S>,
                                              find_face_of_shape<Shape, S>};

/// [m] Returns a point well inside a solid. Zero for other shapes.
template <class S> ISO_INLINE Vec3<S> middle_of(const ShapeView<S>& view) {
  return visit_shape_type(view.primitive.type, [&](auto tag) ISO_INLINE_LAMBDA {
    if constexpr (decltype(tag)::template Of<S>::kBounded) {
      return shape_as<decltype(tag)::template Of>(view).middle();
    } else {
      return Vec3<S>::zero();
    }
  });
}
/// Returns the view of a stored solid. `view` must outlive it.
template <class S> ISO_INLINE SolidView<S> solid_of(const ShapeView<S>& view) {
  return visit_shape_type(view.primitive.type, [&](auto tag) ISO_INLINE_LAMBDA -> SolidView<S> {
    if constexpr (decltype(tag)::template Of<S>::kBounded) {
      const auto shape = shape_as<decltype(tag)::template Of>(view);
      return {kSolidCalls<decltype(tag)::template Of, S>, &view, shape.visit_core(S(0), NoPoint{}),
              shape.inner_radius(), shape.middle()};
    } else {
      ISO_TRAP();
    }
  });
}

/// Returns the support point of a triangle, in the frame of the solid on it. That never asks for its closest point.
template <class S> Vec3<Finer<S>> support_of_triangle(const void* of, Vec3<Unit<Finer<S>>> n) {
  using F = Finer<S>;
  const SurfaceTriangle<S>& triangle = *static_cast<const SurfaceTriangle<S>*>(of);
  Vec3<F> furthest = finer_of<F>(triangle.points[0]);
  F most = dot(n, furthest);
  for (int i = 1; i < 3; ++i) {
    const Vec3<F> p = finer_of<F>(triangle.points[i]);
    const F reach = dot(n, p);
    if (reach > most) most = reach, furthest = p;
  }
  return furthest;
}
template <class S> void find_face_of_triangle(const void* of, Vec3<Unit<S>>, Unit<S>, SolidFace<S>& face) {
  const SurfaceTriangle<S>& triangle = *static_cast<const SurfaceTriangle<S>*>(of);
  face.normal = triangle.normal;
  face.name = 0;
  for (std::uint32_t i = 0; i < 3; ++i) face.add(triangle.points[i], i);
}
template <class S>
inline constexpr SolidCalls<S> kTriangleCalls = {support_of_triangle<S>, nullptr, find_face_of_triangle<S>};

}  // namespace isostep::detail
