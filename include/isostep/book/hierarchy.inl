// Bodies of Hierarchy<S, Volume>: insertion, removal and the two builds. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/hierarchy.hpp"

namespace isostep {

template <class S, class Volume> std::uint32_t Hierarchy<S, Volume>::allocate_pair() {
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
template <class S, class Volume> void Hierarchy<S, Volume>::free_pair(std::uint32_t pair) {
  nodes_[pair].leaves = 0;
  nodes_[pair + 1u].leaves = 0;
  nodes_[pair].child = free_;
  free_ = pair;
}

template <class S, class Volume> std::uint32_t Hierarchy<S, Volume>::make_root() {
  const std::uint32_t root = allocate_pair();
  nodes_[root].parent = kNone;
  nodes_[root].leaves = 0;
  nodes_[root + 1u].leaves = 0;
  return root;
}
template <class S, class Volume> void Hierarchy<S, Volume>::clear() {
  for (std::uint32_t& leaf : leaf_of_) leaf = kNone;
  items_.clear();
  top_ = 0;
  free_ = kNone;
}

/// Moves a subtree's top to `at`, which keeps its parent. Whatever pointed to the top points to `at`.
template <class S, class Volume> void Hierarchy<S, Volume>::place(std::uint32_t at, const Node& node) {
  const std::uint32_t parent = nodes_[at].parent;
  nodes_[at] = node;
  nodes_[at].parent = parent;
  if (node.leaves == 1) {
    leaf_of_[node.child] = at;
  } else {
    nodes_[node.child].parent = at;
    nodes_[node.child + 1u].parent = at;
  }
}

/// Updates numbers of leaves from `at` to the root, and volumes as far as they change, from the children.
template <class S, class Volume> void Hierarchy<S, Volume>::refit_from(std::uint32_t at) {
  for (bool changes = true; at != kNone; at = nodes_[at].parent) {
    Node& node = nodes_[at];
    const Node& first = nodes_[node.child];
    const Node& second = nodes_[node.child + 1u];
    node.leaves = first.leaves + second.leaves;
    if (!changes) continue;
    const Volume volume = merge(first.volume, second.volume);
    changes = !(volume == node.volume);
    node.volume = volume;
  }
}

template <class S, class Volume>
void Hierarchy<S, Volume>::insert(std::uint32_t root, std::uint32_t slot, const Volume& volume) {
  if (slot >= leaf_of_.size()) leaf_of_.resize(slot + 1u, kNone);
  if (nodes_[root].leaves == 0) place(root, {volume, kNone, slot, 1});
  else insert_below(root, slot, volume);
}

template <class S, class Volume>
void Hierarchy<S, Volume>::insert_below(std::uint32_t at, std::uint32_t slot, const Volume& volume) {
  const Sum<S> own = detail::surface(volume);
  while (nodes_[at].leaves != 1) {
    const Node* const children = nodes_.data() + nodes_[at].child;
    Sum<S> cost[2];
    for (std::uint32_t side = 0; side < 2; ++side) {
      const Node& child = children[side];
      cost[side] = detail::surface(merge(child.volume, volume));
      if (child.leaves != 1) cost[side] = cost[side] - detail::surface(child.volume) + own;
    }
    const bool even = cost[0] == cost[1];
    const bool second = even ? children[1].leaves < children[0].leaves : cost[1] < cost[0];
    at = nodes_[at].child + (second ? 1u : 0u);
  }
  const std::uint32_t pair = allocate_pair();
  nodes_[pair].parent = at;
  nodes_[pair + 1u].parent = at;
  place(pair, nodes_[at]);
  place(pair + 1u, {volume, kNone, slot, 1});
  nodes_[at].child = pair;
  nodes_[at].volume = merge(nodes_[pair].volume, volume);
  nodes_[at].leaves = 2;
  refit_from(nodes_[at].parent);
}

template <class S, class Volume> void Hierarchy<S, Volume>::remove(std::uint32_t slot) {
  const std::uint32_t at = leaf_of_[slot];
  const std::uint32_t parent = nodes_[at].parent;
  leaf_of_[slot] = kNone;
  if (parent == kNone) {
    nodes_[at].leaves = 0;
    return;
  }
  place(parent, nodes_[at ^ 1u]);
  free_pair(at & ~1u);
  refit_from(nodes_[parent].parent);
}

/// Moves a leaf. A leaf inside its parent stays its child. Another is inserted anew below the next node above that
/// contains it: a way of few nodes, and not into a larger volume elsewhere that also contains it.
template <class S, class Volume>
void Hierarchy<S, Volume>::move(std::uint32_t root, std::uint32_t slot, const Volume& volume) {
  const std::uint32_t leaf = leaf_of_[slot];
  const std::uint32_t parent = nodes_[leaf].parent;
  if (parent == kNone || contains(nodes_[parent].volume, volume)) {
    nodes_[leaf].volume = volume;
    refit_from(parent);
    return;
  }
  std::uint32_t above = parent;
  while (above != root && !contains(nodes_[above].volume, volume)) above = nodes_[above].parent;
  remove(slot);
  insert_below(above, slot, volume);
}

template <class S, class Volume> void Hierarchy<S, Volume>::stage(std::uint32_t slot, const Volume& volume) {
  if (slot >= leaf_of_.size()) leaf_of_.resize(slot + 1u, kNone);
  items_.push_back({volume, kNone, slot, 1});
}
template <class S, class Volume> void Hierarchy<S, Volume>::build(std::uint32_t root, HierarchyBuild how) {
  if (!items_.empty() && how == HierarchyBuild::top_down) build_top_down(root);
  if (!items_.empty() && how == HierarchyBuild::bottom_up) build_bottom_up(root);
  items_.clear();
}

template <class S, class Volume> void Hierarchy<S, Volume>::build_top_down(std::uint32_t root) {
  order_.clear();
  ranges_.clear();
  ranges_.push_back({0, static_cast<std::uint32_t>(items_.size()), root, 0});
  while (!ranges_.empty()) {
    const Range range = ranges_.back();
    ranges_.pop_back();
    const std::uint32_t count = range.end - range.begin;
    if (count == 1) {
      place(range.node, items_[range.begin]);
      continue;
    }
    const bool in_space = count > 2 && range.depth < kMaxDepth;
    const std::uint32_t middle = in_space ? partition(range.begin, range.end) : range.begin + count / 2u;
    const std::uint32_t pair = allocate_pair();
    nodes_[range.node].child = pair;
    nodes_[pair].parent = range.node;
    nodes_[pair + 1u].parent = range.node;
    order_.push_back(range.node);
    ranges_.push_back({range.begin, middle, pair, range.depth + 1u});
    ranges_.push_back({middle, range.end, pair + 1u, range.depth + 1u});
  }
  for (std::uint32_t i = static_cast<std::uint32_t>(order_.size()); i-- > 0;) {  // children before parents
    Node& node = nodes_[order_[i]];
    node.volume = merge(nodes_[node.child].volume, nodes_[node.child + 1u].volume);
    node.leaves = nodes_[node.child].leaves + nodes_[node.child + 1u].leaves;
  }
}

/// Splits a range at the middle of the longest side of its centres, or in half if one part would be empty.
template <class S, class Volume> std::uint32_t Hierarchy<S, Volume>::partition(std::uint32_t begin, std::uint32_t end) {
  Vec3<S> low = detail::twice_centre(items_[begin].volume);
  Vec3<S> high = low;
  for (std::uint32_t i = begin + 1u; i < end; ++i) {
    const Vec3<S> twice = detail::twice_centre(items_[i].volume);
    low = min(low, twice);
    high = max(high, twice);
  }
  const Vec3<S> side = high - low;
  const int axis = side.x < side.y ? (side.y < side.z ? 2 : 1) : (side.x < side.z ? 2 : 0);
  const S middle = low[axis] + side[axis] * S(0.5);
  std::uint32_t split = begin;
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!(detail::twice_centre(items_[i].volume)[axis] < middle)) continue;
    const Node item = items_[i];
    items_[i] = items_[split];
    items_[split++] = item;
  }
  return split == begin || split == end ? begin + (end - begin) / 2u : split;
}

/// Returns the best partner. Of two equally good ones the earlier wins.
template <class S, class Volume>
typename Hierarchy<S, Volume>::Partner Hierarchy<S, Volume>::best_partner(std::uint32_t of) const {
  Partner best = {Sum<S>{}, kNone};
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    if (i == of) continue;
    const Sum<S> surface = detail::surface(merge(items_[of].volume, items_[i].volume));
    if (best.index == kNone || surface < best.surface) best = {surface, i};
  }
  return best;
}
template <class S, class Volume> std::uint32_t Hierarchy<S, Volume>::nearest_pair() const {
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 1; i < items_.size(); ++i) {
    if (partners_[i].surface < partners_[nearest].surface) nearest = i;
  }
  return nearest;
}

/// Merges items_, the tops of what is merged so far. An item whose partner was one of the two merged finds another one;
/// the rest only compare theirs with the new top.
template <class S, class Volume> void Hierarchy<S, Volume>::build_bottom_up(std::uint32_t root) {
  partners_.resize(items_.size());
  for (std::uint32_t i = 0; i < items_.size(); ++i) partners_[i] = best_partner(i);
  while (items_.size() > 1) {
    const std::uint32_t nearest = nearest_pair();
    const std::uint32_t other = partners_[nearest].index;
    const std::uint32_t kept = nearest < other ? nearest : other, gone = nearest < other ? other : nearest;
    const std::uint32_t pair = allocate_pair();
    place(pair, items_[kept]);
    place(pair + 1u, items_[gone]);
    items_[kept].volume = merge(items_[kept].volume, items_[gone].volume);
    items_[kept].leaves += items_[gone].leaves;
    items_[kept].child = pair;
    const auto last = static_cast<std::uint32_t>(items_.size() - 1u);
    items_[gone] = items_[last];
    partners_[gone] = partners_[last];
    items_.pop_back();
    if (items_.size() == 1) break;
    for (std::uint32_t i = 0; i < last; ++i) {
      Partner& partner = partners_[i];
      const bool lost = i == kept || partner.index == kept || partner.index == gone;
      if (partner.index == last) partner.index = gone;
      if (lost) {
        partner = best_partner(i);
        continue;
      }
      const Sum<S> surface = detail::surface(merge(items_[i].volume, items_[kept].volume));
      if (surface < partner.surface) partner = {surface, kept};
    }
  }
  place(root, items_[0]);
}

template <class S, class Volume> std::uint32_t Hierarchy<S, Volume>::height(std::uint32_t root) const {
  std::uint32_t highest = 0;
  for (const std::uint32_t leaf : leaf_of_) {
    if (leaf == kNone) continue;
    std::uint32_t above = 0, at = leaf;
    for (; nodes_[at].parent != kNone; at = nodes_[at].parent) ++above;
    if (at == root && highest < above) highest = above;
  }
  return highest;
}

template <class S, class Volume> bool Hierarchy<S, Volume>::validate(std::uint32_t root) const {
  if (nodes_[root].parent != kNone) return false;
  bool sound = true;
  std::uint32_t leaves = 0;
  for (std::uint32_t slot = 0; slot < leaf_of_.size(); ++slot) {
    std::uint32_t at = leaf_of_[slot];
    if (at == kNone) continue;
    sound = sound && nodes_[at].leaves == 1 && nodes_[at].child == slot;
    for (; nodes_[at].parent != kNone; at = nodes_[at].parent) {
      const Node& parent = nodes_[nodes_[at].parent];
      sound = sound && parent.child == (at & ~1u);
      sound = sound && parent.leaves == nodes_[at].leaves + nodes_[at ^ 1u].leaves;
      sound = sound && contains(detail::box_around(parent.volume), detail::box_around(nodes_[at].volume));
    }
    leaves += at == root ? 1u : 0u;
  }
  return sound && leaves == nodes_[root].leaves;
}

}  // namespace isostep
