// Bodies of BspTree<S>: where boxes go, and where planes do. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/bsp_tree.hpp"
#include "isostep/book/hierarchy.inl"

namespace isostep {

/// Returns the leaf that contains the box, or the node of the plane that it lies across.
template <class S> std::uint32_t BspTree<S>::place_of(const Aabb<S>& box) const {
  std::uint32_t at = kRoot;
  while (nodes_[at].child != kNone) {
    const Node& node = nodes_[at];
    const int axis = static_cast<int>(node.axis);
    const bool behind = box.high[axis] < node.plane;
    if (!behind && box.low[axis] < node.plane) break;
    at = node.child + (behind ? 0u : 1u);
  }
  return at;
}

/// Begins with one leaf, which is all of space.
template <class S> void BspTree<S>::start() {
  hierarchies_.clear();
  nodes_.clear();
  nodes_.push_back({S(0), 0, kNone, kNone, hierarchies_.make_root()});
}

template <class S> void BspTree<S>::insert(std::uint32_t slot, const Aabb<S>& box) {
  if (nodes_.empty()) start();
  boxes_.insert(slot, box);
  if (slot >= node_of_.size()) node_of_.resize(slot + 1u);
  node_of_[slot] = place_of(box);
  hierarchies_.insert(nodes_[node_of_[slot]].boxes, slot, box);
  ++changes_;
}

template <class S> void BspTree<S>::update(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(contains(slot));
  boxes_.replace(slot, box);
  const std::uint32_t place = place_of(box);
  ++changes_;
  if (place == node_of_[slot]) {
    hierarchies_.move(nodes_[place].boxes, slot, box);
    return;
  }
  hierarchies_.remove(slot);
  hierarchies_.insert(nodes_[place].boxes, slot, box);
  node_of_[slot] = place;
}

template <class S> void BspTree<S>::remove(std::uint32_t slot) {
  boxes_.remove(slot);
  hierarchies_.remove(slot);
  ++changes_;
}

template <class S> void BspTree<S>::optimise() {
  if (changes_ != 0 && size() <= 2u * changes_) rebuild();
}
template <class S> void BspTree<S>::clear() {
  boxes_.clear();
  hierarchies_.clear();
  nodes_.clear();
  changes_ = 0;
}

template <class S> void BspTree<S>::rebuild() {
  start();
  changes_ = 0;
  slots_.clear();
  for (std::uint32_t slot = boxes_.next(0); slot != Bitset::kNone; slot = boxes_.next(slot + 1u))
    slots_.push_back(slot);
  ranges_.clear();
  ranges_.push_back({0, size(), kRoot, 0});
  while (!ranges_.empty()) {
    const Range range = ranges_.back();
    ranges_.pop_back();
    if (range.end - range.begin <= kLeafSize || range.depth == kMaxDepth || !divide(range))
      fill(range.node, range.begin, range.end);
  }
}

/// Divides a range by a plane across the longest side of its centres, in the middle. Moves boxes behind it to the front
/// and those across it to the end. Returns false if one side would be empty or most boxes would lie across.
template <class S> bool BspTree<S>::divide(const Range& range) {
  Vec3<S> low = detail::twice_centre(boxes_[slots_[range.begin]]), high = low;
  for (std::uint32_t i = range.begin + 1u; i < range.end; ++i) {
    const Vec3<S> twice = detail::twice_centre(boxes_[slots_[i]]);
    low = min(low, twice);
    high = max(high, twice);
  }
  const Vec3<S> side = high - low;
  const int axis = side.x < side.y ? (side.y < side.z ? 2 : 1) : (side.x < side.z ? 2 : 0);
  const S plane = (low[axis] + side[axis] * S(0.5)) * S(0.5);
  std::uint32_t behind = range.begin, at = range.begin, across = range.end;
  while (at < across) {
    const std::uint32_t slot = slots_[at];
    const bool is_behind = boxes_[slot].high[axis] < plane, is_across = !is_behind && boxes_[slot].low[axis] < plane;
    if (is_behind) {
      slots_[at++] = slots_[behind];
      slots_[behind++] = slot;
    } else if (is_across) {
      slots_[at] = slots_[--across];
      slots_[across] = slot;
    } else {
      ++at;
    }
  }
  const bool bad = behind == range.begin || behind == across || range.end - across > (range.end - range.begin) / 2u;
  if (bad) return false;
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[range.node].plane = plane;
  nodes_[range.node].axis = static_cast<std::uint32_t>(axis);
  nodes_[range.node].child = child;
  for (std::uint32_t i = 0; i < 2; ++i) nodes_.push_back({S(0), 0, kNone, range.node, hierarchies_.make_root()});
  fill(range.node, across, range.end);
  ranges_.push_back({range.begin, behind, child, range.depth + 1u});
  ranges_.push_back({behind, across, child + 1u, range.depth + 1u});
  return true;
}

template <class S> void BspTree<S>::fill(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    node_of_[slots_[i]] = node;
    hierarchies_.stage(slots_[i], boxes_[slots_[i]]);
  }
  hierarchies_.build(nodes_[node].boxes, HierarchyBuild::top_down);
}

template <class S> bool BspTree<S>::validate() const {
  if (nodes_.empty()) return size() == 0;
  std::uint32_t leaves = 0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (!hierarchies_.validate(nodes_[i].boxes)) return false;
    leaves += hierarchies_.leaves(nodes_[i].boxes);
    const std::uint32_t child = nodes_[i].child;
    if (child != kNone && (nodes_[child].parent != i || nodes_[child + 1u].parent != i)) return false;
  }
  if (leaves != size()) return false;
  for (std::uint32_t slot = boxes_.next(0); slot != Bitset::kNone; slot = boxes_.next(slot + 1u)) {
    if (node_of_[slot] != place_of(boxes_[slot])) return false;
  }
  return true;
}

}  // namespace isostep
