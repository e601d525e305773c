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
  const bool swapped = b.type < a.type;
  const Primitive<S>& first = swapped ? b : a;
  const Primitive<S>& second = swapped ? a : b;
  const Transform<S>& t1 = swapped ? tb : ta;
  const Transform<S>& t2 = swapped ? ta : tb;
  switch (detail::pair_of(first.type, second.type)) {
    case detail::pair_of(sphere, sphere): collide_sphere_sphere(first, t1, second, t2, margin, out); break;
    case detail::pair_of(sphere, box): collide_sphere_box(first, t1, second, t2, margin, out); break;
    case detail::pair_of(sphere, capsule): collide_sphere_capsule(first, t1, second, t2, margin, out); break;
    case detail::pair_of(sphere, half_space): collide_sphere_half_space(first, t1, second, t2, margin, out); break;
    case detail::pair_of(box, box): collide_box_box(first, t1, second, t2, margin, out); break;
    case detail::pair_of(box, capsule): collide_box_capsule(first, t1, second, t2, margin, out); break;
    case detail::pair_of(box, half_space): collide_box_half_space(first, t1, second, t2, margin, out); break;
    case detail::pair_of(capsule, capsule): collide_capsule_capsule(first, t1, second, t2, margin, out); break;
    case detail::pair_of(capsule, half_space): collide_capsule_half_space(first, t1, second, t2, margin, out); break;
    default: out.clear(); break;
  }
  if (swapped) out.normal = -out.normal;
}

}  // namespace isostep
