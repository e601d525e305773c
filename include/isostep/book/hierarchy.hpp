// Hierarchy<S, Volume>: binary trees of bounding volumes, of spheres or of boxes, that share one store of nodes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/book/bounding_volume.hpp"
#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// The way in which a tree is built of leaves that are all known.
enum class HierarchyBuild : std::uint8_t {
  top_down,   // split in two at the middle of the longest side, O(n log n)
  bottom_up,  // merge the two whose common volume is least, again and again: the better tree, O(n^2) as a rule
};

/// The nodes of a tree are known by its root, which stays where it is; a slot is in one tree at most. Siblings lie side
/// by side, so that a walk needs no stack and a tree may have any height.
/// Source:  Millington 2007, ch. 12, p. 235-250: pairs, both builds, insertion by least growth, removal.
/// Differs: a leaf counts with the whole branch that it becomes, as in Goldsmith, Salmon 1987, IEEE CG&A 7(5): a floor
///          grows by nothing that lies within it, and all boxes would hang below it in a list. Of two children that
///          cost the same the one with fewer leaves takes the new one, so that volumes in one place make no list
///          either. Pairs are those of all nodes rather than of the two halves of the root alone.
/// Cost:    insert, remove, move O(height).
template <class S, class Volume> class Hierarchy {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Matches = typename AabbTree<S>::Matches;

  /// Makes an empty tree.
  std::uint32_t make_root();
  /// Forgets all trees, but keeps the memory.
  void clear();

  /// Inserts a slot that is in no tree.
  void insert(std::uint32_t root, std::uint32_t slot, const Volume& volume);
  /// Moves a slot of the tree of this root.
  void move(std::uint32_t root, std::uint32_t slot, const Volume& volume);
  void remove(std::uint32_t slot);
  /// These build an empty tree. stage() comes first, for every slot, with its volume.
  void stage(std::uint32_t slot, const Volume& volume);
  void build(std::uint32_t root, HierarchyBuild how);

  /// Returns the number of leaves of a tree; root_volume() returns its volume.
  ISO_INLINE std::uint32_t leaves(std::uint32_t root) const { return nodes_[root].leaves; }
  ISO_INLINE const Volume& root_volume(std::uint32_t root) const { return nodes_[root].volume; }
  std::uint32_t height(std::uint32_t root) const;
  bool validate(std::uint32_t root) const;

  /// Calls visit(slot) -> bool for the leaves that enters(volume) -> bool admits. Stops at false and returns it.
  template <class Enters, class Visit>
  ISO_INLINE bool traverse(std::uint32_t root, const Enters& enters, const Visit& visit) const;
  /// Calls visit(slot) for the leaves whose volume the sweep of `test` touches, nearer ones first as a rule. `visit`
  /// may shorten the test.
  template <class Visit>
  ISO_INLINE void sweep(std::uint32_t root, detail::SweepTest<S>& test, const Visit& visit) const;

  /// Joins trees: begins with the siblings of all trees, two trees, or a leaf and a tree; then calls visit(slot, slot)
  /// for leaves below whose volumes overlap. Returns false for more than `most` overlaps, of nodes too.
  ISO_INLINE std::uint32_t match_siblings(Matches& matches) const;
  ISO_INLINE void match(Matches& matches, std::uint32_t& count, std::uint32_t node, std::uint32_t other) const;
  ISO_INLINE std::uint32_t leaf_of(std::uint32_t slot) const { return leaf_of_[slot]; }
  template <class Visit>
  ISO_INLINE bool resolve(Matches& matches, std::uint32_t count, std::uint64_t most, const Visit& visit) const;

 private:
  static constexpr std::uint32_t kMaxDepth = 32;  // of splits in space; beyond, ranges are halved

  struct Node {
    Volume volume;
    std::uint32_t parent;
    std::uint32_t child;   // first of the two children; a leaf's slot; the next free pair
    std::uint32_t leaves;  // 1: a leaf; 0: an empty root, a root's unused neighbour, or a free node
  };
  struct Range {
    std::uint32_t begin, end, node, depth;
  };
  /// The best partner of a subtree in the bottom-up build, and the surface of both.
  struct Partner {
    Sum<S> surface;
    std::uint32_t index;
  };

  std::uint32_t allocate_pair();
  void free_pair(std::uint32_t pair);
  void place(std::uint32_t at, const Node& node);
  void refit_from(std::uint32_t at);
  void insert_below(std::uint32_t at, std::uint32_t slot, const Volume& volume);
  void build_top_down(std::uint32_t root);
  std::uint32_t partition(std::uint32_t begin, std::uint32_t end);
  void build_bottom_up(std::uint32_t root);
  Partner best_partner(std::uint32_t of) const;
  std::uint32_t nearest_pair() const;
  ISO_INLINE std::uint32_t near_child(const Node& node, const detail::SweepTest<S>& test) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  // by slot; kNone: in no tree
  std::uint32_t top_ = 0;               // nodes ever in use
  std::uint32_t free_ = kNone;          // first free pair

  std::vector<Node> items_;  // staged
  std::vector<Partner> partners_;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> order_;
};

template <class S, class Volume>
template <class Enters, class Visit>
ISO_INLINE bool Hierarchy<S, Volume>::traverse(std::uint32_t root, const Enters& enters, const Visit& visit) const {
  if (nodes_[root].leaves == 0) return true;
  std::uint32_t at = root;
  for (;;) {
    const Node& node = nodes_[at];
    if (enters(node.volume)) {
      if (node.leaves != 1) {
        at = node.child;
        continue;
      }
      if (!visit(node.child)) return false;
    }
    while (at != root && at % 2u != 0) at = nodes_[at].parent;
    if (at == root) return true;
    ++at;
  }
}

template <class S, class Volume>
ISO_INLINE std::uint32_t Hierarchy<S, Volume>::near_child(const Node& node, const detail::SweepTest<S>& test) const {
  const Vec3<S> to_second =
      detail::twice_centre(nodes_[node.child + 1u].volume) - detail::twice_centre(nodes_[node.child].volume);
  return node.child + (dot_sum(test.displacement, to_second) < product(S(0), S(0)) ? 1u : 0u);
}

/// Source:  Hapala et al. 2011, Efficient Stack-less BVH Traversal for Ray Tracing. On the way back it finds again
///          which child is the near one.
template <class S, class Volume>
template <class Visit>
ISO_INLINE void Hierarchy<S, Volume>::sweep(std::uint32_t root, detail::SweepTest<S>& test, const Visit& visit) const {
  if (nodes_[root].leaves == 0) return;
  std::uint32_t at = root;
  for (;;) {
    const Node& node = nodes_[at];
    if (test.touches(detail::box_around(node.volume))) {
      if (node.leaves != 1) {
        at = near_child(node, test);
        continue;
      }
      visit(node.child);
    }
    while (at != root && at != near_child(nodes_[nodes_[at].parent], test)) at = nodes_[at].parent;
    if (at == root) return;
    at ^= 1u;
  }
}

template <class S, class Volume> ISO_INLINE std::uint32_t Hierarchy<S, Volume>::match_siblings(Matches& matches) const {
  if (matches.now.size() < top_) matches.now.resize(top_);
  std::uint32_t count = 0;
  for (std::uint32_t pair = 0; pair < top_; pair += 2) {
    const bool siblings = nodes_[pair].leaves != 0 && nodes_[pair + 1u].leaves != 0;
    if (siblings) match(matches, count, pair, pair + 1u);
  }
  return count;
}
template <class S, class Volume>
ISO_INLINE void Hierarchy<S, Volume>::match(Matches& matches, std::uint32_t& count, std::uint32_t node,
                                            std::uint32_t other) const {
  if (nodes_[node].leaves == 0 || nodes_[other].leaves == 0) return;
  if (!overlap(nodes_[node].volume, nodes_[other].volume)) return;
  if (matches.now.size() <= count) matches.now.resize(2u * std::size_t{count} + 64u);
  matches.now[count++] = {node, other};
}

/// Descends level by level on both sides at once, as AabbTree does: the matches of a level do not wait for each other.
template <class S, class Volume>
template <class Visit>
ISO_INLINE bool Hierarchy<S, Volume>::resolve(Matches& matches, std::uint32_t count, std::uint64_t most,
                                              const Visit& visit) const {
  while (count != 0) {
    if (most < count) return false;
    most -= count;
    const std::size_t room = 4u * std::size_t{count};
    if (matches.next.size() < room) matches.next.resize(room);
    const auto* const now = matches.now.data();
    auto* const next = matches.next.data();
    std::uint32_t made = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Node& a = nodes_[now[i].a];
      const Node& b = nodes_[now[i].b];
      if (a.leaves == 1 && b.leaves == 1) {
        visit(a.child, b.child);
        continue;
      }
      const std::uint32_t first_a = a.leaves == 1 ? now[i].a : a.child, last_a = first_a + (a.leaves == 1 ? 0u : 1u);
      const std::uint32_t first_b = b.leaves == 1 ? now[i].b : b.child, last_b = first_b + (b.leaves == 1 ? 0u : 1u);
      for (std::uint32_t p = first_a; p <= last_a; ++p) {
        for (std::uint32_t q = first_b; q <= last_b; ++q) {
          next[made] = {p, q};
          made += detail::overlap_flag(nodes_[p].volume, nodes_[q].volume);
        }
      }
    }
    matches.now.swap(matches.next);
    count = made;
  }
  return true;
}

#define ISO_HIERARCHY_OF(extern, S)                      \
  extern template class Hierarchy<S, BoundingSphere<S>>; \
  extern template class Hierarchy<S, Aabb<S>>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_HIERARCHY_OF)

}  // namespace isostep
