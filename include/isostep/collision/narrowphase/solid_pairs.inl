// Bodies of solid_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/cropped_box.hpp"
#include "isostep/collision/narrowphase/half_space_pairs.inl"
#include "isostep/collision/narrowphase/rounded.inl"
#include "isostep/collision/narrowphase/solid_faces.inl"
#include "isostep/collision/narrowphase/solid_pairs.hpp"

namespace isostep {
namespace detail {

/// Collides the cores of two solids like collide_solids, without their radii. a's origin is that of the frame.
template <class S>
void collide_cores(const SolidView<S>& a, const Transform<S>& ta, const SolidView<S>& b, const Transform<S>& tb,
                   S margin, Manifold<S>& out) {
  using F = Finer<S>;
  using U = Unit<F>;
  const S smaller = min(a.inner, b.inner);
  SolidGap<S> gap(a, b, ta, tb);
  const Vec3<S> apart = coarser_of<S>(gap.b_in_a().position);
  const S tolerance = axis_tolerance(a.inner, b.inner, apart);
  const F reach = finer<F>(margin);
  gap.look(finer_of<U>(a.closest(to_world(relative(ta, tb), b.middle)).normal));
  if (gap.best().separation > reach) return;
  gap.look(gap.b_in_a().rotation * finer_of<U>(-b.closest(to_world(relative(tb, ta), a.middle)).normal));
  if (gap.best().separation > reach) return;
  SolidTouch<S> points(a, ta, b, tb, margin, tolerance, out);
  if (points.touch(gap) && points.is_best()) return;
  points.look_at_lines(gap);
  out.clear();
  if (gap.best().separation > reach) return;
  if (points.touch(gap) && points.is_best()) return;
  const F step = finer<F>(max(smaller * S(1.0 / 16), tolerance));
  gap.climb(reach, step);
  out.clear();
  if (gap.best().separation > reach) return;
  if (points.touch(gap) && (gap.best().separation >= F(0) || points.is_best())) return;
  if (gap.best().separation < F(0)) {
    gap.search_everywhere(finer<F>(tolerance * S(0.25)));
    gap.climb(reach, step);
  }
  if (!points.touch(gap)) points.touch_anyway(gap);
}

}  // namespace detail

template <class S>
void collide_solids(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                    Manifold<S>& out) {
  out.clear();
  Primitive<S> near_a = a.primitive, near_b = b.primitive;
  Transform<S> turn_a = {Vec3<S>::zero(), ta.rotation}, b_from_a = {tb.position - ta.position, tb.rotation};
  detail::crop_wide_box(near_a, turn_a, b, b_from_a);
  detail::crop_wide_box(near_b, b_from_a, a, turn_a);
  const Vec3<S> origin = ta.position + turn_a.position;
  b_from_a.position -= turn_a.position;
  turn_a.position = Vec3<S>::zero();
  const ShapeView<S> view_a(near_a, a.content), view_b(near_b, b.content);
  const detail::SolidView<S> of_a = detail::solid_of(view_a), of_b = detail::solid_of(view_b);
  detail::collide_cores(of_a, turn_a, of_b, b_from_a, margin + of_a.radius + of_b.radius, out);
  for (int i = 0; i < out.count; ++i) out.points[i].position += origin;
  if (of_a.radius + of_b.radius > S(0)) detail::grow_cores(out, of_a.radius, of_b.radius, margin);
}

template <class S>
void collide_sphere_solid(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  out.clear();
  const S radius = a.primitive.radius;
  const ClosestPoint<S> nearest =
      visit_shape(b, [&](const auto& solid) ISO_INLINE_LAMBDA { return solid.closest(tb, ta.position); });
  if (nearest.distance - radius > margin) return;
  out.normal = -nearest.normal;
  out.add(ta.position - nearest.normal * ((nearest.distance + radius) * S(0.5)), nearest.distance - radius, 0);
}

template <class S>
void collide_half_space_solid(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                              Manifold<S>& out) {
  out.clear();
  const detail::SolidView<S> solid = detail::solid_of(b);
  const detail::Plane<S> below = detail::plane_below(a.primitive, ta, tb.position);
  detail::RestPlane<S> plane;
  plane.normal = transposed_times(tb.rotation, below.up);
  plane.offset = -below.height;
  plane.own = plane.cut = 0;
  const S tolerance = detail::axis_tolerance(solid.inner, abs(below.height));
  detail::SolidOverPlane<S>(solid, tb, margin + solid.radius, detail::depth_tie(tolerance, S(0)), out).touch(plane);
  if (solid.radius > S(0)) detail::grow_cores(out, solid.radius, S(0), margin);
  out.normal = -out.normal;
}

}  // namespace isostep
