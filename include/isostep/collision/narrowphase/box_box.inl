// Bodies of box_box.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_axes.hpp"
#include "isostep/collision/narrowphase/box_box.hpp"
#include "isostep/collision/narrowphase/face_clip.hpp"

namespace isostep {

template <class S>
void collide_box_box(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                     S margin, Manifold<S>& out) {
  out.clear();
  detail::BoxPair<S> pair;
  pair.half_a = a.half;
  pair.half_b = b.half;
  pair.offset = Vec3<S>::zero();  // for compilers that do not see that only a pair whose axis is known is read
  const detail::BestAxis<S> best = detail::best_axis(pair, ta, tb, margin + a.radius + b.radius);
  if (best.axis < 0) return;
  if (best.axis >= 6) {
    detail::touch_crossing(pair, best, a.radius, ta, b.radius, tb, margin, out);
    return;
  }
  detail::touch_best_faces(pair, best.axis, a.radius, ta, b.radius, tb, margin, out);
}

}  // namespace isostep
