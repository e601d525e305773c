// Body of collide.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.inl"
#include "isostep/collision/narrowphase/box_capsule.inl"
#include "isostep/collision/narrowphase/capsule_pairs.inl"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/half_space_pairs.inl"
#include "isostep/collision/narrowphase/hull_pairs.inl"
#include "isostep/collision/narrowphase/shape_pairs.hpp"
#include "isostep/collision/narrowphase/sphere_pairs.inl"
#include "isostep/collision/narrowphase/surface_pairs.inl"

namespace isostep {

static_assert(detail::kShapePairs<float>.is_complete(), "two shapes have no function in ShapePairs, in list order");

template <class S>
void collide(std::type_identity_t<ShapeView<S>> a, const Transform<S>& ta, std::type_identity_t<ShapeView<S>> b,
             const Transform<S>& tb, S margin, Manifold<S>& out) {
  const ShapeType type_a = a.primitive.type, type_b = b.primitive.type;
  if (type_b < type_a) {
    detail::kShapePairs<S>.of(type_b, type_a)(b, tb, a, ta, margin, out);
    out.normal = -out.normal;
    return;
  }
  detail::kShapePairs<S>.of(type_a, type_b)(a, ta, b, tb, margin, out);
}

}  // namespace isostep
