// CellTree<S, kAxes>: the quad-tree and the oct-tree, cells that are divided in halves along two or three axes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/book/box_cells.hpp"
#include "isostep/book/box_table.hpp"
#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// A BroadPhase. A box is in the cell of its low corner, as deep as cells are there that it is not wider than; a cell
/// is divided once it has kMost boxes, and joined again when kFew are left. Every cell knows a box around what is in it
/// and below, and questions go by these.
/// Source:  Millington 2007, ch. 12, p. 255-258: quad-trees and oct-trees; Ulrich 2000, Loose Octrees, Game Programming
///          Gems: by size, not by where it happens to lie, a box gets down to its level.
/// Differs: the book leaves what lies across a border at the cell that the border divides; each question then meets all
///          that lies across the borders of large cells. The root grows to hold what is inserted.
/// Cost:    insert, update, remove O(depth); depth is at most the logarithm of the world's over the box's width.
template <class S, int kAxes> class CellTree {
 public:
  using Matches = typename AabbTree<S>::Matches;

  void insert(std::uint32_t slot, const Aabb<S>& box);
  void update(std::uint32_t slot, const Aabb<S>& box);
  void remove(std::uint32_t slot);
  /// Shrinks the boxes around cells' contents to fit these.
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

  /// Returns the number of cells that are divided.
  std::uint32_t divided() const { return divided_; }
  bool validate() const;

 private:
  static_assert(kAxes == 2 || kAxes == 3);
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kRoot = 0;
  static constexpr std::uint32_t kChildren = 1u << kAxes;
  static constexpr std::uint32_t kMost = 8;
  static constexpr std::uint32_t kFew = 4;
  static constexpr std::uint32_t kStack = 64 * (kChildren - 1u) + 1u;  // levels are fewer than 64

  struct Node {
    Aabb<S> content;  // [m] around the boxes here and below, larger perhaps until optimise(); if there are any
    std::uint32_t parent;
    std::uint32_t child;  // the first of kChildren; kNone: not divided; the next free block
    std::uint32_t first;  // slot of the first box that is here itself
    std::uint32_t own;    // boxes here itself
    std::uint32_t below;  // boxes here and below
    std::int32_t level;   // of the cell
  };
  struct Link {
    std::uint32_t node, next, previous;  // previous: kNone for a node's first
  };
  using Cells = BoxCells<S>;

  template <class Visit> ISO_INLINE bool query_list(std::uint32_t first, const Aabb<S>& box, const Visit& visit) const;
  template <class Visit> ISO_INLINE bool query_below(std::uint32_t top, const Aabb<S>& box, const Visit& visit) const;
  /// Returns an axis that is divided: x and z, which lie level, or all three.
  static ISO_INLINE constexpr int axis(int i) { return kAxes == 2 ? 2 * i : i; }
  static bool fits(const Cells& cells, int level);
  static std::uint32_t child_of(const Cells& cells, int level);
  bool in_root(const Cells& cells) const;
  void reach_for(const Cells& cells);
  std::uint32_t place_of(const Cells& cells) const;
  std::uint32_t make_place(const Cells& cells);
  std::uint32_t allocate_children(std::uint32_t parent);
  void free_children(std::uint32_t parent);
  void divide(std::uint32_t node);
  void join(std::uint32_t node);
  void link(std::uint32_t node, std::uint32_t slot);
  void unlink(std::uint32_t slot);
  void enclose(std::uint32_t node, const Aabb<S>& box, std::uint32_t more);
  void leave(std::uint32_t node);

  BoxTable<S> boxes_;
  std::vector<Node> nodes_;  // the root, then blocks of kChildren
  std::vector<Link> links_;  // by slot
  std::uint64_t root_cell_[3] = {};
  std::uint32_t free_ = kNone;  // parent's child of the first free block
  std::uint32_t top_ = 0;       // nodes ever in use
  std::uint32_t divided_ = 0;
  bool loose_ = false;                // contents may be smaller than they are said to be
  std::vector<std::uint32_t> order_;  // of optimise()
};

template <class S> using QuadTree = CellTree<S, 2>;
template <class S> using OctTree = CellTree<S, 3>;

template <class S, int kAxes>
template <class Visit>
ISO_INLINE void CellTree<S, kAxes>::query(const Aabb<S>& box, Visit&& visit) const {
  if (size() != 0) query_below(kRoot, box, visit);
}
template <class S, int kAxes>
template <class Visit>
ISO_INLINE bool CellTree<S, kAxes>::query_list(std::uint32_t first, const Aabb<S>& box, const Visit& visit) const {
  for (std::uint32_t slot = first; slot != kNone; slot = links_[slot].next) {
    if (detail::overlap_flag(boxes_[slot], box) != 0 && !visit(slot)) return false;
  }
  return true;
}
template <class S, int kAxes>
template <class Visit>
ISO_INLINE bool CellTree<S, kAxes>::query_below(std::uint32_t top, const Aabb<S>& box, const Visit& visit) const {
  if (nodes_[top].below == 0 || !overlap(nodes_[top].content, box)) return true;
  std::uint32_t stack[kStack];
  std::uint32_t waiting = 0;
  stack[waiting++] = top;
  while (waiting != 0) {
    const Node& node = nodes_[stack[--waiting]];
    if (!query_list(node.first, box, visit)) return false;
    if (node.child == kNone) continue;
    for (std::uint32_t at = node.child; at < node.child + kChildren; ++at) {
      if (nodes_[at].below == 0) continue;
      stack[waiting] = at;
      waiting += detail::overlap_flag(nodes_[at].content, box);
    }
  }
  return true;
}

template <class S, int kAxes>
template <class Visit>
ISO_INLINE void CellTree<S, kAxes>::sweep(const Sweep<S>& sweep, Visit&& visit) const {
  if (size() == 0) return;
  detail::SweepTest<S> test(sweep, boxes_.reach());
  Unit<S> fraction = sweep.max_fraction;
  std::uint32_t farthest = 0;  // number of the child that the sweep comes to last
  for (int i = 0; i < kAxes; ++i) farthest |= test.displacement[axis(i)] < S(0) ? 0u : 1u << i;
  std::uint32_t stack[kStack];
  std::uint32_t waiting = 0;
  stack[waiting++] = kRoot;
  while (waiting != 0) {
    const Node& node = nodes_[stack[--waiting]];
    if (!test.touches(node.content)) continue;
    for (std::uint32_t slot = node.first; slot != kNone; slot = links_[slot].next) {
      if (!test.touches(boxes_[slot])) continue;
      const Unit<S> shorter = visit(slot, fraction);
      if (shorter < fraction) test.shorten(fraction = shorter);
    }
    if (node.child == kNone) continue;
    for (std::uint32_t i = 0; i < kChildren; ++i) {
      const std::uint32_t at = node.child + (i ^ farthest);
      if (nodes_[at].below != 0) stack[waiting++] = at;
    }
  }
}

/// Visits each box with the boxes that follow it: in its cell's list, in cells below, in later siblings of its cell and
/// of those above it.
template <class S, int kAxes>
template <class Visit>
ISO_INLINE bool CellTree<S, kAxes>::overlapping_pairs(Matches&, std::uint64_t most, Visit&& visit) const {
  for (std::uint32_t node = 0; node < top_ && size() != 0; ++node) {
    for (std::uint32_t slot = nodes_[node].first; slot != kNone; slot = links_[slot].next) {
      const Aabb<S>& box = boxes_[slot];
      const auto take = [&](std::uint32_t other) ISO_INLINE_LAMBDA {
        if (most == 0) return false;
        --most;
        visit(slot, other);
        return true;
      };
      bool more = query_list(links_[slot].next, box, take);
      std::uint32_t from = nodes_[node].child, to = from == kNone ? from : from + kChildren;
      for (std::uint32_t at = node; more;) {
        for (; more && from != to; ++from) more = query_below(from, box, take);
        if (at == kRoot) break;
        from = at + 1u;
        to = nodes_[nodes_[at].parent].child + kChildren;
        at = nodes_[at].parent;
      }
      if (!more) return false;
    }
  }
  return true;
}
template <class S, int kAxes>
template <class Visit>
ISO_INLINE bool CellTree<S, kAxes>::overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches&,
                                                         std::uint64_t most, Visit&& visit) const {
  return detail::query_pairs_of(*this, slot_list, most, visit);
}

#define ISO_CELL_TREE_OF(extern, S)     \
  extern template class CellTree<S, 2>; \
  extern template class CellTree<S, 3>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CELL_TREE_OF)

}  // namespace isostep
