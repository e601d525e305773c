// Bodies of half_space_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/half_space_pairs.hpp"

namespace isostep {
namespace detail {

/// A half-space as its partner sees it.
template <class S> struct Plane {
  Vec3<Unit<S>> up;  // [1] out of the half-space, in the transforms' outer frame
  S height;          // [m] of the partner's centre above the plane
};
template <class S>
ISO_INLINE Plane<S> plane_below(const Primitive<S>& half_space, const Transform<S>& t, Vec3<S> centre) {
  const Vec3<Unit<S>> up = t.rotation * half_space.normal;
  return {up, round_to<S>(dot_sum(centre - t.position, up) - widen<SumOf<S, Unit<S>>>(half_space.offset))};
}

/// Adds the core point p, `height` above the plane, unless it is out of reach. The normal points into the half-space.
template <class S>
ISO_INLINE void touch_plane(Vec3<S> p, S height, S radius, S margin, std::uint32_t feature, Manifold<S>& out) {
  if (height - radius > margin) return;
  out.add(p + out.normal * ((height + radius) * S(0.5)), height - radius, feature);
}

/// A box's axes by how much they raise a vertex over the plane.
template <class S> struct RaiseOrder {
  int axes[3];
  S rise[3];  // [m]

  ISO_INLINE constexpr void descend(int i, int j) {
    if (!(rise[i] < rise[j])) return;
    const S r = rise[i];
    const int k = axes[i];
    rise[i] = rise[j];
    axes[i] = axes[j];
    rise[j] = r;
    axes[j] = k;
  }
};

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

/// With the axes ordered by how much they raise a vertex, rise[0] >= rise[1] >= rise[2] >= 0, the heights in ascending
/// order begin: all down; axis 2 up; axis 1 up; then axes 1 and 2 up, or axis 0 alone when that is lower.
template <class S>
void collide_box_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                            const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  const detail::Plane<S> plane = detail::plane_below(b, tb, ta.position);
  const Vec3<S> lift = scale(a.half, transposed_times(ta.rotation, plane.up));
  const Vec3<S> size = abs(lift);
  const S lowest = plane.height - size.x - size.y - size.z;
  if (lowest - a.radius > margin) return;
  out.normal = -plane.up;

  detail::RaiseOrder<S> order = {{0, 1, 2}, {size.x, size.y, size.z}};
  order.descend(0, 1);
  order.descend(1, 2);
  order.descend(0, 1);
  const int* axes = order.axes;
  const S* rise = order.rise;

  const std::uint32_t down = (lift.x < S(0) ? 1u : 0u) | (lift.y < S(0) ? 2u : 0u) | (lift.z < S(0) ? 4u : 0u);
  const std::uint32_t bit[3] = {1u << axes[0], 1u << axes[1], 1u << axes[2]};
  const bool face = rise[1] + rise[2] <= rise[0];
  const std::uint32_t flips[4] = {0, bit[2], bit[1], face ? bit[1] | bit[2] : bit[0]};
  const S raise[4] = {S(0), rise[2], rise[1], face ? rise[1] + rise[2] : rise[0]};
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t corner = down ^ flips[i];
    const Vec3<S> local = {(corner & 1u) ? a.half.x : -a.half.x, (corner & 2u) ? a.half.y : -a.half.y,
                           (corner & 4u) ? a.half.z : -a.half.z};
    detail::touch_plane(to_world(ta, local), lowest + raise[i] + raise[i], a.radius, margin, corner, out);
  }
}

}  // namespace isostep
