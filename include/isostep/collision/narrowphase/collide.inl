// Body of collide.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.inl"
#include "isostep/collision/narrowphase/box_capsule.inl"
#include "isostep/collision/narrowphase/capsule_pairs.inl"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/half_space_pairs.inl"
#include "isostep/collision/narrowphase/shape_pairs.hpp"
#include "isostep/collision/narrowphase/sphere_pairs.inl"

namespace isostep {

static_assert(detail::kShapePairs<float>.is_complete(), "two shapes have no function in ShapePairs, in list order");

template <class S>
void collide(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb, S margin,
             Manifold<S>& out) {
  if (b.type < a.type) {
    detail::kShapePairs<S>.of(b.type, a.type)(b, tb, a, ta, margin, out);
    out.normal = -out.normal;
    return;
  }
  detail::kShapePairs<S>.of(a.type, b.type)(a, ta, b, tb, margin, out);
}

}  // namespace isostep
