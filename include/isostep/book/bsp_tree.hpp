// BspTree<S>: space divided in two by planes, again and again, and a hierarchy of boxes in every part and across every
// plane.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/book/box_table.hpp"
#include "isostep/book/hierarchy.hpp"
#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// A BroadPhase. Planes lie across the axes, as the sides of boxes do, in the middle of the boxes that they divide.
/// What is behind one has no pair with what is in front of it.
/// Source:  Millington 2007, ch. 12, p. 251-255: BSP trees with bounding volume hierarchies at their leaves.
/// Differs: what lies across a plane stays at the plane, in a hierarchy of its own: every box is in one of them only;
///          the planes follow from the boxes rather than from a level's walls, and optimise() chooses them anew once
///          there were half as many changes as there are boxes. In between boxes go where the planes put them.
template <class S> class BspTree {
 public:
  using Matches = typename AabbTree<S>::Matches;

  void insert(std::uint32_t slot, const Aabb<S>& box);
  void update(std::uint32_t slot, const Aabb<S>& box);
  void remove(std::uint32_t slot);
  void optimise();
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

  /// Returns the number of planes that divide space.
  std::uint32_t planes() const { return static_cast<std::uint32_t>(nodes_.size()) / 2u; }
  bool validate() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kRoot = 0;
  static constexpr std::uint32_t kMaxDepth = 24;
  static constexpr std::uint32_t kLeafSize = 16;  // boxes that no plane is looked for

  /// Children are side by side: behind the plane (high < plane), in front of it (low >= plane).
  struct Node {
    S plane;  // [m] along the axis
    std::uint32_t axis;
    std::uint32_t child;  // the first of two; kNone: a leaf
    std::uint32_t parent;
    std::uint32_t boxes;  // root of the hierarchy of what is here: in a leaf, or across the plane
  };
  struct Range {
    std::uint32_t begin, end, node, depth;
  };

  std::uint32_t place_of(const Aabb<S>& box) const;
  void start();
  void rebuild();
  bool divide(const Range& range);
  void fill(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  BoxTable<S> boxes_;
  Hierarchy<S, Aabb<S>> hierarchies_;
  std::vector<Node> nodes_;             // empty: nothing was ever inserted
  std::vector<std::uint32_t> node_of_;  // by slot
  std::uint32_t changes_ = 0;           // since the planes were chosen

  std::vector<std::uint32_t> slots_;  // of the build
  std::vector<Range> ranges_;
};

/// Boxes with high < plane are behind a plane. One of them overlaps only boxes that begin before the plane.
template <class S> template <class Visit> ISO_INLINE void BspTree<S>::query(const Aabb<S>& box, Visit&& visit) const {
  if (size() == 0) return;
  std::uint32_t stack[kMaxDepth + 1u];
  std::uint32_t waiting = 0;
  stack[waiting++] = kRoot;
  while (waiting != 0) {
    const Node& node = nodes_[stack[--waiting]];
    const bool more = hierarchies_.traverse(
        node.boxes, [&](const Aabb<S>& volume) ISO_INLINE_LAMBDA { return overlap(volume, box); }, visit);
    if (!more) return;
    if (node.child == kNone) continue;
    if (node.plane <= box.high[static_cast<int>(node.axis)]) stack[waiting++] = node.child + 1u;
    if (box.low[static_cast<int>(node.axis)] < node.plane) stack[waiting++] = node.child;
  }
}

template <class S>
template <class Visit>
ISO_INLINE void BspTree<S>::sweep(const Sweep<S>& sweep, Visit&& visit) const {
  if (size() == 0) return;
  detail::SweepTest<S> test(sweep, boxes_.reach());
  Unit<S> fraction = sweep.max_fraction;
  std::uint32_t stack[kMaxDepth + 1u];
  std::uint32_t waiting = 0;
  stack[waiting++] = kRoot;
  while (waiting != 0) {
    const Node& node = nodes_[stack[--waiting]];
    hierarchies_.sweep(node.boxes, test, [&](std::uint32_t slot) ISO_INLINE_LAMBDA {
      const Unit<S> shorter = visit(slot, fraction);
      if (shorter < fraction) test.shorten(fraction = shorter);
    });
    if (node.child == kNone) continue;
    const int axis = static_cast<int>(node.axis);
    const bool behind = test.reach.low[axis] < node.plane, in_front = node.plane <= test.reach.high[axis];
    const bool back = test.displacement[axis] < S(0);  // then what is in front is nearer, and goes onto the stack last
    if (back && behind) stack[waiting++] = node.child;
    if (in_front) stack[waiting++] = node.child + 1u;
    if (!back && behind) stack[waiting++] = node.child;
  }
}

/// Pairs are within a hierarchy, or of one across a plane and one below it.
template <class S>
template <class Visit>
ISO_INLINE bool BspTree<S>::overlapping_pairs(Matches& matches, std::uint64_t most, Visit&& visit) const {
  std::uint32_t count = hierarchies_.match_siblings(matches);
  for (const Node& node : nodes_) {
    if (hierarchies_.leaves(node.boxes) == 0) continue;
    for (std::uint32_t above = node.parent; above != kNone; above = nodes_[above].parent)
      hierarchies_.match(matches, count, node.boxes, nodes_[above].boxes);
  }
  return hierarchies_.resolve(matches, count, most, visit);
}

template <class S>
template <class Visit>
ISO_INLINE bool BspTree<S>::overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches&, std::uint64_t most,
                                                 Visit&& visit) const {
  return detail::query_pairs_of(*this, slot_list, most, visit);
}

#define ISO_BSP_TREE_OF(extern, S) extern template class BspTree<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BSP_TREE_OF)

}  // namespace isostep
