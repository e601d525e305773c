// SphereTree<S>: boxes in a hierarchy of bounding spheres.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/book/box_table.hpp"
#include "isostep/book/hierarchy.hpp"
#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// A BroadPhase. Spheres only guide the way: what is visited overlaps by its box.
/// Source:  Millington 2007, ch. 12, p. 233-250: hierarchy of spheres, least-growth insertion, removal, both builds.
/// Cost:    a test of two spheres takes fewer comparisons than one of boxes, but a sphere around a box is larger than
///          it, around a floor or a wall much larger, and so are all above it.
template <class S> class SphereTree {
 public:
  using Matches = typename AabbTree<S>::Matches;

  void insert(std::uint32_t slot, const Aabb<S>& box);
  void update(std::uint32_t slot, const Aabb<S>& box);
  void remove(std::uint32_t slot);
  /// Builds the tree anew, top down, after half as many changes as there are boxes.
  void optimise();
  /// Builds the tree anew.
  void build(HierarchyBuild how);
  void clear();

  ISO_INLINE std::uint32_t size() const { return boxes_.size(); }
  ISO_INLINE bool contains(std::uint32_t slot) const { return boxes_.contains(slot); }
  ISO_INLINE const Aabb<S>& box(std::uint32_t slot) const { return boxes_.box(slot); }

  template <class Visit> ISO_INLINE void query(const Aabb<S>& box, Visit&& visit) const;
  template <class Visit> ISO_INLINE void sweep(const Sweep<S>& sweep, Visit&& visit) const;
  template <class Visit> ISO_INLINE bool overlapping_pairs(Matches& matches, std::uint64_t most, Visit&& visit) const;
  template <class Visit>
  ISO_INLINE bool overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches& matches, std::uint64_t most,
                                       Visit&& visit) const;

  std::uint32_t height() const { return size() == 0 ? 0u : tree_.height(root_); }
  bool validate() const;

 private:
  BoxTable<S> boxes_;
  Hierarchy<S, BoundingSphere<S>> tree_;
  std::uint32_t root_ = Hierarchy<S, BoundingSphere<S>>::kNone;
  std::uint32_t changes_ = 0;  // since the last build
};

template <class S>
template <class Visit>
ISO_INLINE void SphereTree<S>::query(const Aabb<S>& box, Visit&& visit) const {
  if (size() == 0) return;
  tree_.traverse(
      root_, [&](const BoundingSphere<S>& sphere) ISO_INLINE_LAMBDA { return overlap(sphere, box); },
      [&](std::uint32_t slot) ISO_INLINE_LAMBDA { return !overlap(boxes_[slot], box) || visit(slot); });
}

template <class S>
template <class Visit>
ISO_INLINE void SphereTree<S>::sweep(const Sweep<S>& sweep, Visit&& visit) const {
  if (size() == 0) return;
  detail::SweepTest<S> test(sweep, boxes_.reach());
  Unit<S> fraction = sweep.max_fraction;
  tree_.sweep(root_, test, [&](std::uint32_t slot) ISO_INLINE_LAMBDA {
    if (!test.touches(boxes_[slot])) return;
    const Unit<S> shorter = visit(slot, fraction);
    if (shorter < fraction) test.shorten(fraction = shorter);
  });
}

template <class S>
template <class Visit>
ISO_INLINE bool SphereTree<S>::overlapping_pairs(Matches& matches, std::uint64_t most, Visit&& visit) const {
  return tree_.resolve(matches, tree_.match_siblings(matches), most,
                       [&](std::uint32_t slot, std::uint32_t other) ISO_INLINE_LAMBDA {
                         if (overlap(boxes_[slot], boxes_[other])) visit(slot, other);
                       });
}

template <class S>
template <class Visit>
ISO_INLINE bool SphereTree<S>::overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches& matches,
                                                    std::uint64_t most, Visit&& visit) const {
  std::uint32_t count = 0;
  for (const std::uint32_t slot : slot_list) {
    if (contains(slot)) tree_.match(matches, count, tree_.leaf_of(slot), root_);
  }
  return tree_.resolve(matches, count, most, [&](std::uint32_t slot, std::uint32_t other) ISO_INLINE_LAMBDA {
    if (overlap(boxes_[slot], boxes_[other])) visit(slot, other);
  });
}

#define ISO_SPHERE_TREE_OF(extern, S) extern template class SphereTree<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SPHERE_TREE_OF)

}  // namespace isostep
