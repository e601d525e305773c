// Bodies of revolved_revolved.hpp: a capsule on a cylinder or cone.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/revolved_revolved.inl"
#include "isostep/collision/narrowphase/round_polyhedron.inl"

namespace isostep {
namespace detail {

/// Where along a core the distance to the solid is least: that is convex, inside too, and falls against the normal.
template <class S> ISO_INLINE S nearest_along(const Revolved<S>& solid, const Segment<S>& core) {
  constexpr int kHalvings = 30;
  const auto rises = [&](S at) ISO_INLINE_LAMBDA {
    return dot(solid.closest(core.at(at)).normal, core.direction) > Unit<S>(0);
  };
  S low = -core.half, high = core.half;
  if (rises(low)) return low;
  if (!rises(high)) return high;
  for (int i = 0; i < kHalvings && high - low > resolution<S>(); ++i) {
    const S middle = low + (high - low) * S(0.5);
    if (rises(middle)) high = middle;
    else low = middle;
  }
  return low + (high - low) * S(0.5);
}

/// Both ends of the stretch of a line over a disc, `radius` below the core.
template <class S>
ISO_INLINE void touch_disc_along(const Revolved<S>& solid, int end, const Segment<S>& core, S radius, S margin,
                                 const Transform<S>& frame, Manifold<S>& out) {
  const Transform<S> here = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
  const FaceOfOther<S> face = disc_as_face(solid, end, here, 1u << 31);
  S at[2] = {-core.half, core.half};
  std::uint32_t names[2] = {0, 0};
  for (int k = 0; k < face.sides.count; ++k) {
    const S beyond[2] = {face.sides.beyond(k, core.at(at[0])), face.sides.beyond(k, core.at(at[1]))};
    if (beyond[0] > S(0) && beyond[1] > S(0)) return;
    for (int e = 0; e < 2; ++e) {
      if (!(beyond[e] > S(0))) continue;
      at[e] = at[e] + (at[1 - e] - at[e]) * divide_to<Unit<S>>(beyond[e], beyond[e] - beyond[1 - e]);
      names[e] = 1;
    }
  }
  for (std::uint32_t e = 0; e < 2; ++e) {
    const Vec3<S> p = core.at(at[e]);
    const S height = face.height(p);
    if (height - radius <= margin)
      touch_round(p, height, face.normal, radius, frame, face.own | names[e] << 1 | e, out);
  }
}

}  // namespace detail

template <class S>
void collide_capsule_revolved(S half_height, S radius, const Transform<S>& ta, const detail::Revolved<S>& b,
                              const Transform<S>& tb, S margin, Manifold<S>& out) {
  using namespace detail;
  using U = Unit<S>;
  out.clear();
  const Segment<S> core = {to_local(tb, ta.position), transposed_times(tb.rotation, ta.rotation.column(1)),
                           half_height};
  const S at = nearest_along(b, core);
  const ClosestPoint<S> nearest = b.closest(core.at(at));
  if (nearest.distance - radius > margin) return;
  const Vec3<U> n = nearest.normal;
  if (abs(dot(n, core.direction)) <= U(kAlong)) {
    if (n.x == U(0) && n.z == U(0)) {
      touch_disc_along(b, n.y > U(0) ? 1 : 0, core, radius, margin, tb, out);
    } else if (n.y == b.up) {
      const RevolvedTouch<S> touch(b, tb, margin, S(0), out);
      touch.beside(core.at(-half_height) - n * radius, core.direction, half_height + half_height, n, 1u << 30);
      out.normal = -out.normal;
    }
    if (out.count > 0) return;
  }
  touch_round(core.at(at), nearest.distance, n, radius, tb, 0, out);
}

}  // namespace isostep
