// FlatPatch<S>: the points of one convex on the triangles of one flat surface, as a single manifold.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/face_clip.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"

namespace isostep {

/// Joins the manifolds of a convex with triangles to one for all of them, so that friction acts once, in the middle of
/// the touching patch, however the surface is cut into triangles.
/// Method:  as in Box3D and Jolt: all points with one normal, of which reduce_to_four() keeps those that span most.
///          Points are sorted by feature, so that the same points give the same four whatever triangles they are on.
template <class S> class FlatPatch {
 public:
  ISO_INLINE explicit FlatPatch(const Manifold<S>& first)
      : normal_(first.normal), origin_(first.points[0].position), across_(tangents_of(first.normal)) {
    polygon_.count = 0;
    add(first);
  }

  /// Returns true if the other's normal equals that of the first, to kAlike.
  ISO_INLINE bool takes(const Manifold<S>& other) const { return max_abs(other.normal - normal_) <= Unit<S>(kAlike); }
  ISO_INLINE void add(const Manifold<S>& other) {
    for (int i = 0; i < other.count; ++i) add(other.points[i]);
  }
  /// Writes the manifold. `tie` [m]: of points within it of the deepest, the first counts as the deepest.
  ISO_INLINE void write(S tie, Manifold<S>& out) {
    if (polygon_.count > kMaxContactPoints) detail::reduce_to_four(polygon_, tie);
    out.normal = normal_;
    out.count = 0;
    for (int i = 0; i < polygon_.count; ++i) {
      const ManifoldPoint<S>& p = points_[polygon_.points[i].after];
      out.add(p.position, p.separation, p.feature);
    }
  }

 private:
  static constexpr double kAlike = 0x1p-7;  // [1] of normals; what is not flat to the eye differs by more
  static constexpr int kMost = 48;          // points; beyond it the ones so far are reduced to four

  /// Adds a point, sorted by feature. Two neighbouring triangles may both have the point.
  ISO_INLINE void add(ManifoldPoint<S> point) {
    if (polygon_.count == kMost) shrink();
    int at = 0;
    while (at < polygon_.count && polygon_.points[at].before < point.feature) ++at;
    while (at < polygon_.count && polygon_.points[at].before == point.feature) {
      if (point.feature >> 28 == triangle_feature::kOfConvexAlone >> 28) return;
      point.feature += 1u << 24;  // of cuts, which other triangles name alike
      while (at < polygon_.count && polygon_.points[at].before < point.feature) ++at;
    }
    for (int i = polygon_.count; i > at; --i) polygon_.points[i] = polygon_.points[i - 1];
    const Vec3<S> beside = point.position - origin_;
    const auto index = static_cast<std::uint32_t>(polygon_.count++);
    polygon_.points[at] = {dot(across_.t, beside), dot(across_.u, beside), point.separation, point.feature, index};
    points_[index] = point;
  }
  ISO_INLINE void shrink() {
    detail::reduce_to_four(polygon_, S(0));
    ManifoldPoint<S> kept[kMaxContactPoints];
    for (int i = 0; i < polygon_.count; ++i) kept[i] = points_[polygon_.points[i].after];
    for (int i = 0; i < polygon_.count; ++i) {
      points_[i] = kept[i];
      polygon_.points[i].after = static_cast<std::uint32_t>(i);
    }
  }

  const Vec3<Unit<S>> normal_;
  const Vec3<S> origin_;  // [m] that tangents are measured from
  const Tangents<Unit<S>> across_;
  detail::ClipPolygon<S, kMost> polygon_;  // by feature; `before` is that, `after` the place in points_
  ManifoldPoint<S> points_[kMost];
};

}  // namespace isostep
