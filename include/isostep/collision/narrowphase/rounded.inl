// Parts of pairs with a rounded hull: the gap of two cores, and manifolds of cores made into those of their skins.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/collision/narrowphase/gjk.inl"
#include "isostep/collision/narrowphase/manifold.hpp"

namespace isostep::detail {

/// Turns a manifold of two cores into that of their skins, `a` and `b` [m] around them. Drops points beyond the margin.
template <class S> ISO_INLINE void grow_cores(Manifold<S>& m, S a, S b, S margin) {
  const S radii = a + b;
  const Vec3<S> shift = m.normal * ((a - b) * S(0.5));
  bool touches = false;
  int kept = 0;
  for (int i = 0; i < m.count; ++i) {
    const ManifoldPoint<S> p = m.points[i];
    touches = touches || p.separation - radii <= margin;
    if (p.separation - radii > margin + kPatchReach<S>) continue;
    m.points[kept++] = {p.position + shift, p.separation - radii, p.feature};
  }
  m.count = kept;
  if (!touches) m.clear();
}

/// The gap of two cores at their nearest points, in a's frame. Cores that are not apart overlap, or are too near for a
/// direction.
template <class S> struct CoreGap {
  bool is_apart;
  S distance;            // [m] along the normal: no more than the cores are apart
  Vec3<Unit<S>> normal;  // [1] from a to b
  Vec3<S> on_a, on_b;    // [m]
  int corners;           // of b that are nearest: 1 a vertex, 2 an edge, 3 a face
  std::uint32_t corner[3];

  ISO_INLINE Vec3<S> across() const { return normal * distance; }
  /// Returns true if a manifold of the cores, whose normal is in a's frame, shows the same gap, to within `tolerance`
  /// [m]: it reaches as far along its own normal, and has a point there.
  ISO_INLINE bool is_told_by(const Manifold<S>& cores, Vec3<Unit<S>> normal_in_a, S tolerance) const {
    S least = highest<S>();
    for (int i = 0; i < cores.count; ++i) least = min(least, cores.points[i].separation);
    return cores.count > 0 && dot(normal_in_a, across()) >= distance - tolerance && least <= distance + tolerance;
  }
  /// Adds the one point there. Its name does not depend on the feature: a contact that rolls from feature to feature
  /// stays the same.
  ISO_INLINE void touch(const Transform<S>& frame, S a, S b, Manifold<S>& out) const {
    out.normal = frame.rotation * normal;
    out.add(to_world(frame, on_a + normal * ((distance + a - b) * S(0.5))), distance - a - b, kNearest);
  }
  static constexpr std::uint32_t kNearest = 1u << 27;
};

/// Converts the gap that a search found to S.
template <class S> ISO_INLINE CoreGap<S> gap_of(const GjkDistance<Finer<S>>& found, const Simplex<Finer<S>>& simplex) {
  CoreGap<S> gap = {};
  gap.is_apart = found.distance > Finer<S>(0);
  gap.distance = coarser<S>(found.distance);
  gap.normal = coarser_of<Unit<S>>(found.normal);
  gap.on_a = coarser_of<S>(found.on_a);
  gap.on_b = coarser_of<S>(found.on_b);
  for (int i = 0; gap.is_apart && i < simplex.count; ++i) {
    const std::uint32_t vertex = simplex.points[i].vertex_b;
    bool known = false;
    for (int k = 0; k < gap.corners; ++k) known = known || gap.corner[k] == vertex;
    if (!known) gap.corner[gap.corners++] = vertex;
  }
  return gap;
}

/// Finds the gap by GJK, in the finer format: a skin of a few digits of S has a direction there, too.
template <class S>
ISO_INLINE CoreGap<S> gap_between(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                                  const Transform<S>& tb) {
  using F = Finer<S>;
  const FineCore<S> fine_a(a), fine_b(b);
  const Transform<F> b_in_a = fine_relative(ta, tb);
  const Gjk<F> search(fine_a.vertices, fine_b.vertices, b_in_a);
  Simplex<F> simplex = search.begin();
  const GjkDistance<F> found = search.run(simplex);
  return gap_of<S>(found, simplex);
}

}  // namespace isostep::detail
