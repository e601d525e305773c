// Bodies of AabbTree<S>: insertion, refitting and the build. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/tree.hpp"

namespace isostep {

template <class S> std::uint32_t AabbTree<S>::allocate_pair() {
  std::uint32_t pair = free_;
  if (pair != kNone) {
    free_ = nodes_[pair].child;
    return pair;
  }
  pair = top_;
  top_ += 2;
  if (top_ > nodes_.size()) nodes_.resize(top_);
  return pair;
}

template <class S> void AabbTree<S>::free_pair(std::uint32_t pair) {
  nodes_[pair].height = kFreeHeight;
  nodes_[pair + 1u].height = kFreeHeight;
  nodes_[pair].child = free_;
  free_ = pair;
}

/// Moves a subtree's top node to `at`, whose parent stays. Links to the top node then point to `at`.
template <class S> void AabbTree<S>::place(std::uint32_t at, const Node& node) {
  const std::uint32_t parent = nodes_[at].parent;
  nodes_[at] = node;
  nodes_[at].parent = parent;
  if (node.height == 0) {
    leaf_of_[node.child] = at;
  } else {
    nodes_[node.child].parent = at;
    nodes_[node.child + 1u].parent = at;
  }
}

/// Sets the exact box and height of an inner node. Returns true if either changed.
template <class S> bool AabbTree<S>::refit(std::uint32_t at) {
  Node& node = nodes_[at];
  const Node& left = nodes_[node.child];
  const Node& right = nodes_[node.child + 1u];
  const Aabb<S> box = merge(left.box, right.box);
  const std::uint32_t height = 1u + (left.height < right.height ? right.height : left.height);
  if (box == node.box && height == node.height) return false;
  node.box = box;
  node.height = height;
  return true;
}
/// Refits nodes from `at` towards the root, as long as anything changes.
template <class S> void AabbTree<S>::refit_from(std::uint32_t at) {
  while (at != kNone && refit(at)) at = nodes_[at].parent;
}

/// Rotates every node from `at` to the root whose children differ in height by two or more: the higher child's higher
/// child swaps with the lower child. Marks the nodes.
template <class S> void AabbTree<S>::level_from(std::uint32_t at) {
  for (; at != kNone; at = nodes_[at].parent) {
    const std::uint32_t first = nodes_[at].child;
    const std::uint32_t low = nodes_[first + 1u].height < nodes_[first].height ? first + 1u : first;
    const std::uint32_t high = low ^ 1u;
    if (nodes_[low].height + 2u <= nodes_[high].height) {
      const std::uint32_t below = nodes_[high].child;
      const std::uint32_t rising = nodes_[below].height < nodes_[below + 1u].height ? below + 1u : below;
      const Node risen = nodes_[rising];
      place(rising, nodes_[low]);
      place(low, risen);
      nodes_[high].marked = 1;
      refit(high);
    }
    refit(at);
  }
}

/// Finds the node to pair a new leaf with: goes down to the cheaper child while that adds less surface than a stop. A
/// stop at n costs area(n + box). Going on to child c costs n's growth and, for a leaf c, area(c + box); for an inner c
/// at least its growth and area(box). The growth of n's ancestors is common to both. n's growth, taken from both,
/// leaves area(n) against the child's part. Of two that cost the same the lower subtree wins: boxes in one place would
/// make a list of the tree otherwise.
template <class S> std::uint32_t AabbTree<S>::find_sibling(const Aabb<S>& box) const {
  const Sum<S> own = half_area(box);
  std::uint32_t at = kRoot;
  while (nodes_[at].height != 0) {
    const Node* const children = nodes_.data() + nodes_[at].child;
    Sum<S> cost[2];
    for (std::uint32_t side = 0; side < 2; ++side) {
      const Node& child = children[side];
      cost[side] = half_area(merge(child.box, box));
      if (child.height != 0) cost[side] = cost[side] - half_area(child.box) + own;
    }
    const bool even = cost[0] == cost[1];
    const std::uint32_t cheaper = (even ? children[1].height < children[0].height : cost[1] < cost[0]) ? 1u : 0u;
    if (half_area(nodes_[at].box) < cost[cheaper]) break;
    at = nodes_[at].child + cheaper;
  }
  return at;
}

template <class S> void AabbTree<S>::insert(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(!contains(slot));
  if (slot >= leaf_of_.size()) leaf_of_.resize(slot + 1u, kNone);
  const Node leaf = {box, kNone, slot, 0, 0};
  if (size_++ == 0) {
    top_ = 2;  // node 1, the root's sibling, is never used
    if (nodes_.size() < top_) nodes_.resize(top_);
    nodes_[kRoot].parent = kNone;
    place(kRoot, leaf);
    return;
  }
  const std::uint32_t sibling = find_sibling(box);
  const std::uint32_t pair = allocate_pair();
  nodes_[pair].parent = sibling;
  nodes_[pair + 1u].parent = sibling;
  place(pair, nodes_[sibling]);
  place(pair + 1u, leaf);
  nodes_[sibling].child = pair;
  nodes_[sibling].height = kFreeHeight;  // differs from what refit_from finds, so that it starts
  refit_from(sibling);
  for (std::uint32_t at = sibling; at != kNone && nodes_[at].marked == 0; at = nodes_[at].parent) nodes_[at].marked = 1;
  if (height() > height_to_level(size_)) level_from(sibling);
  if (height() > kMaxHeight) rebuild();
}

template <class S> void AabbTree<S>::remove(std::uint32_t slot) {
  ISO_ASSERT(contains(slot));
  const std::uint32_t at = leaf_of_[slot];
  leaf_of_[slot] = kNone;
  if (--size_ == 0) {
    top_ = 0;
    return;
  }
  const std::uint32_t parent = nodes_[at].parent;
  place(parent, nodes_[at ^ 1u]);
  free_pair(at & ~1u);
  refit_from(nodes_[parent].parent);
  if (size_ == 1) {
    top_ = 2;
    free_ = kNone;
  }
}

template <class S> void AabbTree<S>::update(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(contains(slot));
  std::uint32_t at = leaf_of_[slot];
  nodes_[at].box = box;
  for (at = nodes_[at].parent; at != kNone; at = nodes_[at].parent) {
    Node& node = nodes_[at];
    if (node.marked != 0 && isostep::contains(node.box, box)) return;
    node.marked = 1;
    node.box = merge(node.box, box);
  }
}

template <class S> void AabbTree<S>::optimise() {
  if (size_ == 0 || nodes_[kRoot].marked == 0) return;
  collect_items(false);
  build();
  if (height() > kMaxHeight) rebuild();
}

template <class S> void AabbTree<S>::stage(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(!contains(slot));
  if (slot >= leaf_of_.size()) leaf_of_.resize(slot + 1u, kNone);
  items_.push_back({box, kNone, slot, 0, 0});
}

template <class S> void AabbTree<S>::rebuild() {
  const std::uint32_t staged = static_cast<std::uint32_t>(items_.size());
  if (size_ != 0) collect_items(true);
  size_ += staged;
  if (size_ != 0) build();
}

template <class S> void AabbTree<S>::clear() {
  for (std::uint32_t& leaf : leaf_of_) leaf = kNone;
  items_.clear();
  top_ = 0;
  free_ = kNone;
  size_ = 0;
}

/// Takes the tree apart from the root: frees marked nodes, or all inner nodes. The subtrees below become items.
template <class S> void AabbTree<S>::collect_items(bool all) {
  order_.clear();
  if (nodes_[kRoot].height == 0) {
    items_.push_back(nodes_[kRoot]);
  } else {
    order_.push_back(kRoot);
  }
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    const std::uint32_t first = nodes_[order_[i]].child;
    for (std::uint32_t at = first; at <= first + 1u; ++at) {
      const Node& node = nodes_[at];
      if (node.height == 0 || (node.marked == 0 && !all)) {
        items_.push_back(node);
      } else {
        order_.push_back(at);
      }
    }
  }
  // Children are freed first: a pair that is freed overwrites its own link.
  for (std::size_t i = order_.size(); i-- > 0;) free_pair(nodes_[order_[i]].child);
}

/// Builds the tree over items_, top down. Then sets boxes and heights bottom up, since every node is made before its
/// children.
/// Depth: kMaxDepth splits at the middle of space, then at most 32 at the middle of the list, stay below kMaxHeight as
///        long as all items are leaves.
template <class S> void AabbTree<S>::build() {
  const std::uint32_t count = static_cast<std::uint32_t>(items_.size());
  built_ += count;
  if (count == size_) {  // all items are leaves, so no node is in use: lay the nodes out in the order of a walk
    top_ = 2;
    free_ = kNone;
    nodes_.resize(nodes_.size() < 2u * count ? 2u * count : nodes_.size());
  }
  centres_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) centres_[i] = {items_[i].box.low + items_[i].box.high, i};
  nodes_[kRoot].parent = kNone;
  order_.clear();
  ranges_.clear();
  ranges_.push_back({0, count, kRoot, 0});
  std::uint32_t giants = split_off_giants();
  while (!ranges_.empty()) {
    const Range range = ranges_.back();
    ranges_.pop_back();
    if (range.end - range.begin == 1) {
      place(range.node, items_[centres_[range.begin].index()]);
      continue;
    }
    std::uint32_t middle = range.begin + (range.end - range.begin) / 2u;
    if (giants != 0) {
      middle = range.begin + 1u;
      --giants;
    } else if (range.end - range.begin > 2 && range.depth < kMaxDepth) {
      middle = partition(range.begin, range.end);
    }
    const std::uint32_t pair = allocate_pair();
    nodes_[range.node].child = pair;
    nodes_[range.node].marked = 0;
    nodes_[pair].parent = range.node;
    nodes_[pair + 1u].parent = range.node;
    order_.push_back(range.node);
    ranges_.push_back({range.begin, middle, pair, range.depth + 1u});
    ranges_.push_back({middle, range.end, pair + 1u, range.depth + 1u});
  }
  for (std::uint32_t i = static_cast<std::uint32_t>(order_.size()); i-- > 0;) {
    Node& node = nodes_[order_[i]];
    const Node& left = nodes_[node.child];
    const Node& right = nodes_[node.child + 1u];
    node.box = merge(left.box, right.box);
    node.height = 1u + (left.height < right.height ? right.height : left.height);
  }
  items_.clear();
}

/// Moves items with at least a quarter of the area of all centres (grounds, half-spaces) to the front. Returns
/// their number. Near the root they enlarge no box below. They are few, since each makes the tree one level
/// deeper.
template <class S> std::uint32_t AabbTree<S>::split_off_giants() {
  const std::uint32_t count = static_cast<std::uint32_t>(centres_.size());
  if (count <= 2 * kMaxGiants) return 0;
  Aabb<S> region = {centres_[0].twice, centres_[0].twice};
  for (const Centre& centre : centres_) region = {min(region.low, centre.twice), max(region.high, centre.twice)};
  // Centres are doubled, so a quarter of them spans half of the true extents: a quarter of the area.
  region = {region.low * S(0.25), region.high * S(0.25)};
  const Sum<S> large = half_area(region);
  std::uint32_t giants = 0;
  for (std::uint32_t i = 0; i < count && giants < kMaxGiants; ++i) {
    if (half_area(items_[centres_[i].index()].box) < large) continue;
    const Centre giant = centres_[i];
    centres_[i] = centres_[giants];
    centres_[giants++] = giant;
  }
  return giants;
}

/// Splits a range of centres at the middle of its longest side, or by count if that leaves one part empty.
template <class S> std::uint32_t AabbTree<S>::partition(std::uint32_t begin, std::uint32_t end) {
  Vec3<S> low = centres_[begin].twice;
  Vec3<S> high = low;
  for (std::uint32_t i = begin + 1u; i < end; ++i) {
    low = min(low, centres_[i].twice);
    high = max(high, centres_[i].twice);
  }
  const Vec3<S> side = high - low;
  const int axis = side.x < side.y ? (side.y < side.z ? 2 : 1) : (side.x < side.z ? 2 : 0);
  S Vec3<S>::*const component = axis == 0 ? &Vec3<S>::x : axis == 1 ? &Vec3<S>::y : &Vec3<S>::z;
  const S middle = low.*component + side.*component * S(0.5);
  std::uint32_t split = begin;
  for (std::uint32_t i = begin; i < end; ++i) {  // swaps always, so that no branch depends on the data
    const Centre centre = centres_[i];
    centres_[i] = centres_[split];
    centres_[split] = centre;
    split += centre.twice.*component < middle ? 1u : 0u;
  }
  return split == begin || split == end ? begin + (end - begin) / 2u : split;
}

template <class S> bool AabbTree<S>::validate() const {
  std::uint32_t leaves = 0;
  for (std::uint32_t slot = 0; slot < leaf_of_.size(); ++slot) {
    const std::uint32_t at = leaf_of_[slot];
    if (at == kNone) continue;
    ++leaves;
    if (at >= top_ || nodes_[at].height != 0 || nodes_[at].child != slot) return false;
  }
  std::uint32_t free_nodes = 0;
  for (std::uint32_t pair = free_; pair != kNone; pair = nodes_[pair].child) {
    if (pair >= top_ || nodes_[pair].height != kFreeHeight || nodes_[pair + 1u].height != kFreeHeight) return false;
    free_nodes += 2;
  }
  if (leaves != size_) return false;
  if (size_ == 0) return top_ == 0 || free_nodes + 2 == top_;
  if (free_nodes + 2u * size_ != top_ || nodes_[kRoot].parent != kNone || height() > kMaxHeight) return false;
  for (std::uint32_t at = 0; at < top_; at += at == 0 ? 2u : 1u) {
    const Node& node = nodes_[at];
    if (node.height == kFreeHeight || node.height == 0) continue;
    const Node& left = nodes_[node.child];
    const Node& right = nodes_[node.child + 1u];
    if (left.parent != at || right.parent != at) return false;
    if (node.height != 1u + (left.height < right.height ? right.height : left.height)) return false;
    if (node.marked == 0 && (left.marked != 0 || right.marked != 0)) return false;
    const Aabb<S> exact = merge(left.box, right.box);
    if (node.marked == 0 ? !(node.box == exact) : !isostep::contains(node.box, exact)) return false;
  }
  return true;
}

}  // namespace isostep
