// Bodies of collide.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.inl"
#include "isostep/collision/narrowphase/box_capsule.inl"
#include "isostep/collision/narrowphase/capsule_pairs.inl"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/half_space_pairs.inl"
#include "isostep/collision/narrowphase/hull_pairs.inl"
#include "isostep/collision/narrowphase/shape_pairs.hpp"
#include "isostep/collision/narrowphase/solid_pairs.inl"
#include "isostep/collision/narrowphase/sphere_pairs.inl"
#include "isostep/collision/narrowphase/surface_pairs.inl"

namespace isostep {

#ifndef __SANITIZE_ADDRESS__  // GCC with -fsanitize=undefined takes no function's address for a constant
static_assert(detail::kShapePairs<float>.is_complete(), "two shapes have no function in ShapePairs, in list order");
#endif

template <class S>
void collide(std::type_identity_t<ShapeView<S>> a, const Transform<S>& ta, std::type_identity_t<ShapeView<S>> b,
             const Transform<S>& tb, S margin, Manifold<S>& out, std::type_identity_t<CollidePolyhedra<S>> polyhedra) {
  const ShapeType type_a = a.primitive.type, type_b = b.primitive.type;
  if (type_b < type_a) {
    detail::kShapePairs<S>.of(type_b, type_a)(b, tb, a, ta, margin, out, polyhedra);
    out.normal = -out.normal;
    return;
  }
  detail::kShapePairs<S>.of(type_a, type_b)(a, ta, b, tb, margin, out, polyhedra);
}

template <class S>
void collide_leaves(const LeafView<S>& a, const Transform<S>& ta, const LeafView<S>& b, const Transform<S>& tb,
                    S margin, Manifold<S>& out, CollidePolyhedra<S> polyhedra) {
  if (is_surface(b.shape.primitive.type)) {
    collide_with_triangle(a.shape, ta, b.shape, b.triangle, tb, margin, out);
  } else if (is_surface(a.shape.primitive.type)) {
    collide_with_triangle(b.shape, tb, a.shape, a.triangle, ta, margin, out);
    out.normal = -out.normal;
  } else {
    collide(a.shape, ta, b.shape, tb, margin, out, polyhedra);
  }
}

}  // namespace isostep
