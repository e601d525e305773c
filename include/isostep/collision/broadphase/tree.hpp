// AabbTree<S>: a dynamic tree of fat boxes, for pairs, overlap queries and swept queries.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep {

/// A box of half extents `half` (zero: a ray) that moves from `origin` by `displacement`.
template <class S> struct Sweep {
  Vec3<S> origin;        // [m], world frame
  Vec3<S> displacement;  // [m]
  Vec3<S> half;          // [m]
  Unit<S> max_fraction;  // [1] in [0, 1], of the displacement
};

namespace detail {
/// Returns overlap() as 0 or 1, without branches. In a join the results are hard to predict, and a mispredicted branch
/// costs more than six comparisons.
template <class S> ISO_INLINE std::uint32_t overlap_flag(const Aabb<S>& a, const Aabb<S>& b) {
  return static_cast<std::uint32_t>(a.low.x <= b.high.x) & static_cast<std::uint32_t>(b.low.x <= a.high.x) &
         static_cast<std::uint32_t>(a.low.y <= b.high.y) & static_cast<std::uint32_t>(b.low.y <= a.high.y) &
         static_cast<std::uint32_t>(a.low.z <= b.high.z) & static_cast<std::uint32_t>(b.low.z <= a.high.z);
}

/// Tells whether a sweep may touch a box, by the separating axes of a segment and a box grown by `half`: the box's
/// three, with the segment's own bounds, and their cross products with the displacement. Exact sums in fixed point.
/// Error: in float, with coordinates up to f, the two sides of a cross product axis err by less than
///        14 eps f (|da| + |db|) together; the slack of 16 eps f on each half extent adds 32: no touched box is missed.
template <class S> struct SweepTest {
  Vec3<S> origin, displacement, steps;  // steps: |displacement| by component
  Vec3<S> half;                         // [m] with slack
  Aabb<S> reach;                        // around the part of the sweep that is still of interest

  ISO_INLINE SweepTest(const Sweep<S>& sweep, const Aabb<S>& root)
      : origin(sweep.origin), displacement(sweep.displacement), steps(abs(sweep.displacement)) {
    const S far_end = max_abs(max(abs(origin + displacement), abs(origin) + sweep.half));
    const S farthest = max(far_end, max(max_abs(root.low), max_abs(root.high)));
    const S step = resolution<S>() * S(16);
    const S slack = farthest * step + step;
    half = sweep.half + Vec3<S>{slack, slack, slack};
    shorten(sweep.max_fraction);
  }
  ISO_INLINE void shorten(Unit<S> max_fraction) {
    const Vec3<S> end = origin + displacement * max_fraction;
    reach = {min(origin, end) - half, max(origin, end) + half};
  }
  ISO_INLINE bool touches(const Aabb<S>& box) const {
    if (!overlap(reach, box)) return false;
    const Vec3<S> c = box.low + box.high - (origin + origin);  // twice the centre, from the origin
    const Vec3<S> h = box.high - box.low + (half + half);
    return within(displacement.y, displacement.z, c.y, c.z, steps.y, steps.z, h.y, h.z) &&
           within(displacement.z, displacement.x, c.z, c.x, steps.z, steps.x, h.z, h.x) &&
           within(displacement.x, displacement.y, c.x, c.y, steps.x, steps.y, h.x, h.y);
  }

 private:
  static ISO_INLINE bool within(S da, S db, S ca, S cb, S sa, S sb, S ha, S hb) {
    const Sum<S> side = product(da, cb) - product(db, ca);
    const Sum<S> reach_of_box = product(sa, hb) + product(sb, ha);
    return side <= reach_of_box && -side <= reach_of_box;
  }
};
}  // namespace detail

/// A binary tree of boxes over leaves that the caller names by small integers (slots), each at most once.
///
/// The tree is a cache, not state: its shape depends on its history, and so does the order of visits. The set of leaves
/// that `query` and `overlapping_pairs` visit does not. A caller whose results depend on order sorts.
///
/// Siblings lie side by side (nodes 2k and 2k + 1; the root is node 0), a leaf is a node of height 0. `update` only
/// enlarges ancestors and marks them. `optimise` takes the marked part apart and rebuilds it over the subtrees below: a
/// few moves cost little, and many cost one build. Until then boxes are exact, except above a moved leaf.
/// Source:  Catto 2022-2024, Box2D 3 (enlarge, then rebuild the enlarged part); Goldsmith, Salmon 1987, IEEE CG&A 7(5)
///          (insertion by surface area).
/// Boxes inserted in order, row by row, would form a list. Where the tree is half as high again as it needs to be,
/// `insert` rotates the nodes above the new leaf, like an AVL tree.
/// Cost:    insert, remove O(height); update O(height) at worst; optimise O(m log m), m = subtrees below marked nodes.
/// Limits:  box.low <= box.high; coordinates within 4 position limits (geometry/limits.hpp), so that doubled centres
///          and half areas fit.
///          Height at most kMaxHeight, kept by rebuilding where rotations are not enough.
template <class S> class AabbTree {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kMaxHeight = 80;

  /// Two nodes of a join whose boxes overlap.
  struct NodePair {
    std::uint32_t a, b;
  };
  /// Holds the working memory of a join. Keep it from one to the next.
  struct Matches {
    std::vector<NodePair> now, next;
  };

  /// The slot must be free.
  void insert(std::uint32_t slot, const Aabb<S>& box);
  /// The slot must be taken.
  void remove(std::uint32_t slot);
  void update(std::uint32_t slot, const Aabb<S>& box);
  /// Restores the tree's quality after inserts and updates. Call it once before many queries. Results do not need it.
  void optimise();

  /// stage() and rebuild() insert in bulk: stage any number, then rebuild. Other calls between the two are not
  /// allowed.
  void stage(std::uint32_t slot, const Aabb<S>& box);
  void rebuild();

  /// Removes all leaves, keeps the memory.
  void clear();

  ISO_INLINE std::uint32_t size() const { return size_; }
  ISO_INLINE std::uint32_t height() const { return size_ == 0 ? 0u : nodes_[kRoot].height; }
  /// The number of leaves and subtrees over which all builds were made, for tests.
  ISO_INLINE std::uint64_t built() const { return built_; }
  ISO_INLINE bool contains(std::uint32_t slot) const { return slot < leaf_of_.size() && leaf_of_[slot] != kNone; }
  ISO_INLINE const Aabb<S>& box(std::uint32_t slot) const { return nodes_[leaf_of_[slot]].box; }

  /// Calls visit(slot) -> bool for every leaf whose box overlaps `box`, in no stated order. False ends the query. Where
  /// weak symbols matter, a visitor of this class is a struct with an ISO_INLINE call operator.
  template <class Visit> ISO_INLINE void query(const Aabb<S>& box, Visit&& visit) const;

  /// Calls visit(slot) -> bool for the leaves for which overlaps(box) -> bool is true of their own box and of every box
  /// above it. Returns false if visit wanted no more.
  template <class Overlaps, class Visit> ISO_INLINE bool traverse(const Overlaps& overlaps, Visit&& visit) const;

  /// Calls visit(slot) -> bool for leaves that come after the slot's own in the tree's walk and whose boxes overlap its
  /// box, nearest in the tree first. False ends it. enter(node) -> bool decides by values of `fold` whether to look at
  /// a node at all.
  template <class Enter, class Visit>
  ISO_INLINE void query_behind(std::uint32_t slot, const Enter& enter, const Visit& visit) const;
  /// Does query_behind() for all leaves, the slot's own among them, in the order of the walk.
  template <class Enter, class Visit>
  ISO_INLINE void query_all(std::uint32_t slot, const Enter& enter, const Visit& visit) const;
  /// Computes a value for every node: leaf(slot) for a leaf, both(a, b) of its children's values otherwise. The tree
  /// must just have been rebuilt.
  template <class Value, class Leaf, class Both>
  ISO_INLINE void fold(std::vector<Value>& values, const Leaf& leaf, const Both& both) const;

  /// Calls visit(slot, slot) once for every two leaves whose boxes overlap, in no stated order, either first. Returns
  /// false if it gives up after `most` overlaps of leaves and inner nodes. Some pairs are not visited then.
  template <class Visit> ISO_INLINE bool overlapping_pairs(Matches& matches, std::uint64_t most, Visit&& visit) const;

  /// Calls visit(slot, other) for every one of `slots` that is in the tree and every leaf, itself included, whose box
  /// overlaps its own, in no stated order. It takes half the time of as many queries. Returns false if it gives up,
  /// like overlapping_pairs().
  template <class Visit>
  ISO_INLINE bool overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches& matches, std::uint64_t most,
                                       Visit&& visit) const;

  /// Calls visit(slot, max_fraction) -> the new max_fraction, not larger, for every leaf whose box the sweep touches
  /// within the current fraction, as a rule nearer ones first. The visitor may get leaves that it must reject. Of two
  /// hits at one fraction it prefers the lower slot: then the nearest hit does not depend on the tree's shape.
  template <class Visit> ISO_INLINE void sweep(const Sweep<S>& sweep, Visit&& visit) const;

  /// Checks that links, heights, marks, containment, free list and slots agree, for tests.
  bool validate() const;

 private:
  static constexpr std::uint32_t kRoot = 0;
  static constexpr std::uint32_t kFreeHeight = 0xffffffffu;
  static constexpr std::uint32_t kMaxDepth = 32;
  static constexpr std::uint32_t kMaxGiants = 8;
  /// Returns the height above which `insert` rotates: half as much again as the least height for that many leaves. An
  /// AVL tree is no higher, and few insertions rotate.
  static ISO_INLINE std::uint32_t height_to_level(std::uint32_t leaves) {
    return 2u + 3u * static_cast<std::uint32_t>(std::bit_width(leaves)) / 2u;
  }

  struct Node {
    Aabb<S> box;
    std::uint32_t parent;
    std::uint32_t child;   // first of the two children; a leaf's slot; the next free pair
    std::uint32_t height;  // 0: leaf
    std::uint32_t marked;  // 1: a leaf below has been inserted or moved since the last build; so are all ancestors
  };
  struct Centre {
    Vec3<S> twice;    // [m] low + high
    RawBits<S> item;  // an index, as wide as S: copying a struct with a padded tail made the build twice as slow
    ISO_INLINE std::uint32_t index() const { return static_cast<std::uint32_t>(item); }
  };
  struct Range {
    std::uint32_t begin, end, node, depth;
  };

  template <class Visit>
  ISO_INLINE bool resolve(Matches& matches, std::uint32_t count, std::uint64_t most, Visit&& visit) const;
  template <class Enter, class Visit>
  ISO_INLINE bool query_below(std::uint32_t at, const Aabb<S>& box, const Enter& enter, const Visit& visit) const;
  std::uint32_t allocate_pair();
  void free_pair(std::uint32_t pair);
  void place(std::uint32_t at, const Node& node);
  bool refit(std::uint32_t node);
  void refit_from(std::uint32_t node);
  void level_from(std::uint32_t node);
  std::uint32_t find_sibling(const Aabb<S>& box) const;
  void collect_items(bool all);
  void build();
  std::uint32_t split_off_giants();
  std::uint32_t partition(std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  // by slot
  std::uint32_t top_ = 0;               // nodes ever in use, the rest of nodes_ is spare
  std::uint32_t free_ = kNone;          // first free pair
  std::uint32_t size_ = 0;
  std::uint64_t built_ = 0;

  std::vector<Node> items_;  // subtrees to be built over
  std::vector<Centre> centres_;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> order_;
};

template <class S> template <class Visit> ISO_INLINE void AabbTree<S>::query(const Aabb<S>& box, Visit&& visit) const {
  traverse([&](const Aabb<S>& node) ISO_INLINE_LAMBDA { return overlap(node, box); }, visit);
}

template <class S>
template <class Overlaps, class Visit>
ISO_INLINE bool AabbTree<S>::traverse(const Overlaps& overlaps, Visit&& visit) const {
  if (size_ == 0 || !overlaps(nodes_[kRoot].box)) return true;
  std::uint32_t stack[kMaxHeight + 1u];
  std::uint32_t waiting = 0;
  stack[waiting++] = kRoot;
  while (waiting != 0) {
    const Node& node = nodes_[stack[--waiting]];
    if (node.height == 0) {
      if (!visit(node.child)) return false;
      continue;
    }
    if (overlaps(nodes_[node.child + 1u].box)) stack[waiting++] = node.child + 1u;
    if (overlaps(nodes_[node.child].box)) stack[waiting++] = node.child;
  }
  return true;
}

/// Returns false when the visitor wants no more.
template <class S>
template <class Enter, class Visit>
ISO_INLINE bool AabbTree<S>::query_below(std::uint32_t top, const Aabb<S>& box, const Enter& enter,
                                         const Visit& visit) const {
  std::uint32_t stack[kMaxHeight + 1u];
  std::uint32_t waiting = 0;
  stack[waiting++] = top;
  while (waiting != 0) {
    const std::uint32_t at = stack[--waiting];
    const Node& node = nodes_[at];
    if (!overlap(node.box, box) || !enter(at)) continue;
    if (node.height == 0) {
      if (!visit(node.child)) return false;
      continue;
    }
    stack[waiting++] = node.child + 1u;
    stack[waiting++] = node.child;
  }
  return true;
}
template <class S>
template <class Enter, class Visit>
ISO_INLINE void AabbTree<S>::query_behind(std::uint32_t slot, const Enter& enter, const Visit& visit) const {
  const Aabb<S>& box = nodes_[leaf_of_[slot]].box;
  for (std::uint32_t at = leaf_of_[slot]; at != kRoot; at = nodes_[at].parent) {
    const bool first = at % 2u == 0;
    if (first && !query_below(at + 1u, box, enter, visit)) return;
  }
}
template <class S>
template <class Enter, class Visit>
ISO_INLINE void AabbTree<S>::query_all(std::uint32_t slot, const Enter& enter, const Visit& visit) const {
  query_below(kRoot, nodes_[leaf_of_[slot]].box, enter, visit);
}

template <class S>
template <class Value, class Leaf, class Both>
ISO_INLINE void AabbTree<S>::fold(std::vector<Value>& values, const Leaf& leaf, const Both& both) const {
  values.resize(top_);
  for (std::uint32_t at = kRoot; at < top_; at += at == kRoot ? 2u : 1u) {  // node 1 is never used
    if (nodes_[at].height == 0) values[at] = leaf(nodes_[at].child);
  }
  for (std::size_t i = order_.size(); i-- > 0;) {  // of the build: parents before children
    const std::uint32_t child = nodes_[order_[i]].child;
    values[order_[i]] = both(values[child], values[child + 1u]);
  }
}

template <class S>
template <class Visit>
ISO_INLINE bool AabbTree<S>::overlapping_pairs(Matches& matches, std::uint64_t most, Visit&& visit) const {
  // Two leaves have one lowest common ancestor, so it is enough to match the two children of every inner node.
  if (matches.now.size() < top_) matches.now.resize(top_);
  std::uint32_t count = 0;
  for (std::uint32_t pair = 2; pair < top_; pair += 2) {
    matches.now[count] = {pair, pair + 1u};
    count += nodes_[pair].height != kFreeHeight ? detail::overlap_flag(nodes_[pair].box, nodes_[pair + 1u].box) : 0u;
  }
  return resolve(matches, count, most, visit);
}

template <class S>
template <class Visit>
ISO_INLINE bool AabbTree<S>::overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches& matches,
                                                  std::uint64_t most, Visit&& visit) const {
  if (matches.now.size() < slot_list.size()) matches.now.resize(slot_list.size());
  std::uint32_t count = 0;
  for (const std::uint32_t slot : slot_list) {
    if (contains(slot)) matches.now[count++] = {leaf_of_[slot], kRoot};
  }
  return resolve(matches, count, most, visit);
}

/// Opens matches until both sides are leaves, level by level rather than depth first. The matches of a level only wait
/// for memory, so the processor works on several at once. With a stack each step waits for the one before (measured:
/// twice the time).
template <class S>
template <class Visit>
ISO_INLINE bool AabbTree<S>::resolve(Matches& matches, std::uint32_t count, std::uint64_t most, Visit&& visit) const {
  while (count != 0) {
    if (most < count) return false;
    most -= count;
    const std::size_t room = 4u * std::size_t{count};
    if (matches.next.size() < room) matches.next.resize(room);
    const NodePair* const now = matches.now.data();
    NodePair* const next = matches.next.data();
    std::uint32_t made = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const NodePair at = now[i];
      const Node& a = nodes_[at.a];
      const Node& b = nodes_[at.b];
      if (a.height == 0 && b.height == 0) {
        visit(a.child, b.child);
        continue;
      }
      const NodePair first = {a.height == 0 ? at.a : a.child, b.height == 0 ? at.b : b.child};
      const NodePair last = {a.height == 0 ? at.a : a.child + 1u, b.height == 0 ? at.b : b.child + 1u};
      for (std::uint32_t p = first.a; p <= last.a; ++p) {
        for (std::uint32_t q = first.b; q <= last.b; ++q) {
          next[made] = {p, q};
          made += detail::overlap_flag(nodes_[p].box, nodes_[q].box);
        }
      }
    }
    matches.now.swap(matches.next);
    count = made;
  }
  return true;
}

template <class S>
template <class Visit>
ISO_INLINE void AabbTree<S>::sweep(const Sweep<S>& sweep, Visit&& visit) const {
  if (size_ == 0) return;
  detail::SweepTest<S> test(sweep, nodes_[kRoot].box);
  Unit<S> fraction = sweep.max_fraction;
  std::uint32_t stack[kMaxHeight + 1u];
  std::uint32_t waiting = 0;
  stack[waiting++] = kRoot;
  while (waiting != 0) {
    const Node& node = nodes_[stack[--waiting]];
    if (!test.touches(node.box)) continue;
    if (node.height == 0) {
      const Unit<S> shorter = visit(node.child, fraction);
      if (shorter < fraction) test.shorten(fraction = shorter);
      continue;
    }
    const Aabb<S>& left = nodes_[node.child].box;
    const Aabb<S>& right = nodes_[node.child + 1u].box;
    const Vec3<S> to_right = (right.low - left.low) + (right.high - left.high);
    const std::uint32_t right_first = dot_sum(test.displacement, to_right) < product(S(0), S(0)) ? 1u : 0u;
    stack[waiting++] = node.child + 1u - right_first;
    stack[waiting++] = node.child + right_first;
  }
}

#define ISO_EXTERN_AABB_TREE(S) extern template class AabbTree<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_AABB_TREE)
#undef ISO_EXTERN_AABB_TREE

}  // namespace isostep
