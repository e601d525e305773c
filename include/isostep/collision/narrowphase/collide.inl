// Bodies of collide.hpp: one switch over the pairs of types.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.inl"
#include "isostep/collision/narrowphase/box_capsule.inl"
#include "isostep/collision/narrowphase/capsule_pairs.inl"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/half_space_pairs.inl"
#include "isostep/collision/narrowphase/sphere_pairs.inl"

namespace isostep {
namespace detail {

ISO_INLINE constexpr int pair_of(ShapeType a, ShapeType b) {
  return static_cast<int>(a) * kShapeTypes + static_cast<int>(b);
}

}  // namespace detail

template <class S>
void collide(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb, S margin,
             Manifold<S>& out) {
  using enum ShapeType;
  if (b.type < a.type) {
    collide(b, tb, a, ta, margin, out);
    out.normal = -out.normal;
    return;
  }
  switch (detail::pair_of(a.type, b.type)) {
    case detail::pair_of(sphere, sphere): return collide_sphere_sphere(a, ta, b, tb, margin, out);
    case detail::pair_of(sphere, box): return collide_sphere_box(a, ta, b, tb, margin, out);
    case detail::pair_of(sphere, capsule): return collide_sphere_capsule(a, ta, b, tb, margin, out);
    case detail::pair_of(sphere, half_space): return collide_sphere_half_space(a, ta, b, tb, margin, out);
    case detail::pair_of(box, box): return collide_box_box(a, ta, b, tb, margin, out);
    case detail::pair_of(box, capsule): return collide_box_capsule(a, ta, b, tb, margin, out);
    case detail::pair_of(box, half_space): return collide_box_half_space(a, ta, b, tb, margin, out);
    case detail::pair_of(capsule, capsule): return collide_capsule_capsule(a, ta, b, tb, margin, out);
    case detail::pair_of(capsule, half_space): return collide_capsule_half_space(a, ta, b, tb, margin, out);
    default: out.clear(); break;
  }
}

}  // namespace isostep
