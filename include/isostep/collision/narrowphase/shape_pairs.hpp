// The table of pairs of shapes: which function finds the contact points of which two.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.hpp"
#include "isostep/collision/narrowphase/box_capsule.hpp"
#include "isostep/collision/narrowphase/capsule_pairs.hpp"
#include "isostep/collision/narrowphase/half_space_pairs.hpp"
#include "isostep/collision/narrowphase/hull_pairs.hpp"
#include "isostep/collision/narrowphase/solid_pairs.hpp"
#include "isostep/collision/narrowphase/sphere_pairs.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"

namespace isostep::detail {

/// Collides two shapes whose types ascend, like collide().
template <class S>
using CollideShapes = void (*)(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                               Manifold<S>& out, CollidePolyhedra<S> polyhedra);

/// Leaves out pairs that pass through each other, also for queries: shapes that only static bodies have.
template <class S>
void collide_never(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, S, Manifold<S>& out,
                   CollidePolyhedra<S>) {
  out.clear();
}

/// Collides shapes that are complete in their records.
template <class S>
using CollidePrimitives = void (*)(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                                   const Transform<S>& tb, S margin, Manifold<S>& out);
template <class S, CollidePrimitives<S> Collide>
void collide_records(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                     Manifold<S>& out, CollidePolyhedra<S>) {
  Collide(a.primitive, ta, b.primitive, tb, margin, out);
}
/// Collides shapes of which at most one is a polyhedron.
template <class S>
using CollideViews = void (*)(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                              Manifold<S>& out);
template <class S, CollideViews<S> Collide>
void collide_views(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                   Manifold<S>& out, CollidePolyhedra<S>) {
  Collide(a, ta, b, tb, margin, out);
}

/// by_type[a][b], a <= b.
template <class S> struct ShapePairs {
  CollideShapes<S> by_type[kShapeTypes][kShapeTypes] = {};

  constexpr ShapePairs() {
    using enum ShapeType;
    for (int a = 0; a < kShapeTypes; ++a) {
      for (int b = a; b < kShapeTypes; ++b)
        by_type[a][b] = of_all(static_cast<ShapeType>(a), static_cast<ShapeType>(b));
    }
    add(sphere, sphere, collide_records<S, collide_sphere_sphere<S>>);
    add(sphere, box, collide_records<S, collide_sphere_box<S>>);
    add(sphere, capsule, collide_records<S, collide_sphere_capsule<S>>);
    add(sphere, half_space, collide_records<S, collide_sphere_half_space<S>>);
    add(box, box, collide_records<S, collide_box_box<S>>);
    add(box, capsule, collide_records<S, collide_box_capsule<S>>);
    add(box, half_space, collide_records<S, collide_box_half_space<S>>);
    add(capsule, capsule, collide_records<S, collide_capsule_capsule<S>>);
    add(capsule, half_space, collide_records<S, collide_capsule_half_space<S>>);
    add(sphere, hull, collide_views<S, collide_sphere_hull<S>>);
    add(box, hull, collide_box_hull<S>);
    add(capsule, hull, collide_views<S, collide_capsule_hull<S>>);
    add(half_space, hull, collide_views<S, collide_half_space_hull<S>>);
    add(hull, hull, collide_hull_hull<S>);
  }
  ISO_INLINE constexpr CollideShapes<S> of(ShapeType a, ShapeType b) const {
    return by_type[static_cast<std::uint32_t>(a)][static_cast<std::uint32_t>(b)];
  }
  ISO_INLINE constexpr bool is_complete() const {
    for (int a = 0; a < kShapeTypes; ++a) {
      for (int b = a; b < kShapeTypes; ++b) {
        if (by_type[a][b] == nullptr) return false;
      }
    }
    return true;
  }

 private:
  /// Returns the function of two shapes that have none of their own. Null if one is a new unbounded shape.
  static constexpr CollideShapes<S> of_all(ShapeType a, ShapeType b) {
    if (!is_bounded(a) && !is_bounded(b)) return collide_never<S>;
    if (is_surface(b)) return collide_views<S, collide_with_surface<S>>;
    if (is_surface(a)) return collide_views<S, collide_surface_with<S>>;
    if (a == ShapeType::half_space) return collide_views<S, collide_half_space_solid<S>>;
    if (!is_bounded(a) || !is_bounded(b)) return nullptr;
    if (a == ShapeType::sphere) return collide_views<S, collide_sphere_solid<S>>;
    return collide_views<S, collide_solids<S>>;
  }
  constexpr void add(ShapeType a, ShapeType b, CollideShapes<S> collide) {
    by_type[static_cast<std::uint32_t>(a)][static_cast<std::uint32_t>(b)] = collide;
  }
};
template <class S> inline constexpr ShapePairs<S> kShapePairs{};

}  // namespace isostep::detail
