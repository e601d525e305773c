// NarrowPhase: the manifolds on one flat surface become one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/flat_patch.hpp"
#include "isostep/systems/contacts/narrow_phase.hpp"
#include "isostep/systems/contacts/part_pairs.inl"

namespace isostep {

/// Joins the manifolds of a convex part on one flat surface of one material. The first of them becomes the manifold of
/// all, the others become empty.
template <class S> void NarrowPhase<S>::join_flat(const PairRun<S>& run) const {
  std::uint32_t i = run.begin;
  while (i < run.end) {
    const PartPair& pair = run.pairs[run.order[i]];
    const BodyFrame<S>&a = run.frames[pair.frame_a], &b = run.frames[pair.frame_b];
    i = (a.surfaces || b.surfaces) && !is_sensed(pair) ? join_flat(run, i) : i + 1;
  }
}
/// Joins the manifolds of one pair of bodies. Returns the index at which the next pair begins.
template <class S> std::uint32_t NarrowPhase<S>::join_flat(const PairRun<S>& run, std::uint32_t begin) const {
  constexpr S kTie = S(0x1p-12);  // [m] what lies level differs by less
  const PartPair& bodies = run.pairs[run.order[begin]];
  std::uint32_t end = begin;
  const auto same_bodies = [&](const PartPair& pair) {
    return pair.frame_a == bodies.frame_a && pair.frame_b == bodies.frame_b;
  };
  while (end < run.end && same_bodies(run.pairs[run.order[end]])) ++end;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t at = run.order[i];
    if (run.counts[at] == 0) continue;
    FlatPatch<S> patch(run.manifolds[at]);
    bool any = false;
    for (std::uint32_t j = i + 1; j < end; ++j) {
      const std::uint32_t other = run.order[j];
      if (run.counts[other] == 0 || !patch.takes(run.manifolds[other]) || !lie_alike(run.pairs[at], run.pairs[other]))
        continue;
      patch.add(run.manifolds[other]);
      run.counts[other] = 0;
      any = true;
    }
    if (!any) continue;
    patch.write(kTie, run.manifolds[at]);
    run.counts[at] = static_cast<std::uint8_t>(run.manifolds[at].count);
  }
  return end;
}
/// Returns true if two pairs of the same bodies share the convex part, and the material and belt of their triangles.
template <class S> bool NarrowPhase<S>::lie_alike(const PartPair& x, const PartPair& y) const {
  const std::vector<BodyFrame<S>>& frames = part_pairs_.frames();
  const bool of_a = frames[x.frame_a].surfaces;
  if (of_a ? x.child_b != y.child_b : x.child_a != y.child_a) return false;
  const BodyFrame<S>& ground = frames[of_a ? x.frame_a : x.frame_b];
  const std::uint32_t leaf_x = of_a ? x.child_a : x.child_b, leaf_y = of_a ? y.child_a : y.child_b;
  if (belts_ != nullptr && belts_->find(ground.slot, leaf_x) != belts_->find(ground.slot, leaf_y)) return false;
  const Leaf p = detail::leaf_at(ground, leaf_x), q = detail::leaf_at(ground, leaf_y);
  const bool as_body = (ground.children[p.child].traits.flags | ground.children[q.child].traits.flags) == 0;
  if (p.child != q.child && !as_body) return false;
  const ShapeView<S> of_p = detail::part(ground, p.child), of_q = detail::part(ground, q.child);
  if (!is_surface(of_p.primitive.type) || !is_surface(of_q.primitive.type)) return false;
  const SurfaceMaterial *const m = listed_material(of_p, p.triangle), *const n = listed_material(of_q, q.triangle);
  return m == n || (m != nullptr && n != nullptr && *m == *n);
}

}  // namespace isostep
