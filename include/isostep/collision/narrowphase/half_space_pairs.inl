// Bodies of half_space_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/half_space_pairs.hpp"

namespace isostep {
namespace detail {

/// A half-space's plane below a shape.
template <class S> struct Plane {
  Vec3<Unit<S>> up;  // [1] out of the half-space, in the transforms' outer frame
  S height;          // [m] of the partner's centre above the plane
};
template <class S>
ISO_INLINE Plane<S> plane_below(const Primitive<S>& half_space, const Transform<S>& t, Vec3<S> centre) {
  const Vec3<Unit<S>> up = t.rotation * half_space.normal;
  return {up, round_to<S>(dot_sum(centre - t.position, up) - widen<SumOf<S, Unit<S>>>(half_space.offset))};
}

/// Adds the core point p, `height` above the plane, if it belongs to the patch. The normal points into the half-space.
template <class S>
ISO_INLINE void touch_plane(Vec3<S> p, S height, S radius, S margin, std::uint32_t feature, Manifold<S>& out) {
  if (height - radius > margin + kPatchReach<S>) return;
  out.add(p + out.normal * ((height + radius) * S(0.5)), height - radius, feature);
}

}  // namespace detail

template <class S>
void collide_sphere_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                               const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  const detail::Plane<S> plane = detail::plane_below(b, tb, ta.position);
  if (plane.height - a.radius > margin) return;
  out.normal = -plane.up;
  detail::touch_plane(ta.position, plane.height, a.radius, margin, 0, out);
}

template <class S>
void collide_capsule_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                                const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  const detail::Plane<S> plane = detail::plane_below(b, tb, ta.position);
  const Vec3<S> end = ta.rotation.column(1) * a.half.y;
  const S rise = dot(end, plane.up);
  if (plane.height - abs(rise) - a.radius > margin) return;
  out.normal = -plane.up;
  detail::touch_plane(ta.position - end, plane.height - rise, a.radius, margin, 0, out);
  detail::touch_plane(ta.position + end, plane.height + rise, a.radius, margin, 1, out);
}

template <class S>
void collide_box_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                            const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  const detail::Plane<S> plane = detail::plane_below(b, tb, ta.position);
  const Vec3<Unit<S>> up = transposed_times(ta.rotation, plane.up), steep = abs(up);
  const Vec3<S> lift = scale(a.half, up), size = abs(lift);
  const S lowest = plane.height - size.x - size.y - size.z;
  if (lowest - a.radius > margin) return;
  out.normal = -plane.up;

  const int facing = steep.x >= steep.y && steep.x >= steep.z ? 0 : steep.y >= steep.z ? 1 : 2;
  const int i = facing < 2 ? facing + 1 : 0, j = facing < 1 ? 2 : facing - 1;
  const std::uint32_t down = (lift.x < S(0) ? 1u : 0u) | (lift.y < S(0) ? 2u : 0u) | (lift.z < S(0) ? 4u : 0u);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const S raise = ((k & 1u) != 0 ? size[i] : S(0)) + ((k & 2u) != 0 ? size[j] : S(0));
    const std::uint32_t corner = down ^ ((k & 1u) << i) ^ ((k >> 1) << j);
    const Vec3<S> local = {(corner & 1u) ? a.half.x : -a.half.x, (corner & 2u) ? a.half.y : -a.half.y,
                           (corner & 4u) ? a.half.z : -a.half.z};
    detail::touch_plane(to_world(ta, local), lowest + raise + raise, a.radius, margin, corner, out);
  }
}

}  // namespace isostep
