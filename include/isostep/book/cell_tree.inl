// Bodies of CellTree<S, kAxes>: where boxes go, division and joining of cells. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/cell_tree.hpp"

namespace isostep {

/// Returns true if the box lies in at most two cells of a level along each axis.
template <class S, int kAxes> bool CellTree<S, kAxes>::fits(const Cells& cells, int level) {
  bool fits = level >= 0;
  for (int i = 0; i < kAxes && fits; ++i) fits = (cells.high[axis(i)] - cells.low[axis(i)]) >> level == 0;
  return fits;
}
/// Returns the child of a cell one level above that contains the low corner.
template <class S, int kAxes> std::uint32_t CellTree<S, kAxes>::child_of(const Cells& cells, int level) {
  std::uint32_t number = 0;
  for (int i = 0; i < kAxes; ++i) number |= static_cast<std::uint32_t>(cells.low[axis(i)] >> level & 1u) << i;
  return number;
}

template <class S, int kAxes> bool CellTree<S, kAxes>::in_root(const Cells& cells) const {
  bool in = true;
  for (int i = 0; i < kAxes; ++i) in = in && cells.low[axis(i)] >> nodes_[kRoot].level == root_cell_[i];
  return in;
}

/// Grows the tree: the root becomes a child of a cell twice as wide, until it contains the low corner. An empty root
/// becomes a cell as wide as the box.
template <class S, int kAxes> void CellTree<S, kAxes>::reach_for(const Cells& cells) {
  if (size() == 0) {
    clear();
    top_ = 1;
    if (nodes_.empty()) nodes_.resize(1);
    nodes_[kRoot] = {{}, kNone, kNone, kNone, 0, 0, cells.size_class()};
    for (int i = 0; i < kAxes; ++i) root_cell_[i] = cells.low[axis(i)] >> nodes_[kRoot].level;
    return;
  }
  while (!in_root(cells) || !fits(cells, nodes_[kRoot].level)) {
    std::uint32_t number = 0;
    for (int i = 0; i < kAxes; ++i) {
      number |= static_cast<std::uint32_t>(root_cell_[i] & 1u) << i;
      root_cell_[i] >>= 1;
    }
    const Node old = nodes_[kRoot];
    nodes_[kRoot].level = old.level + 1;
    if (old.child == kNone) continue;
    nodes_[kRoot] = {old.content, kNone, kNone, kNone, 0, old.below, old.level + 1};
    const std::uint32_t at = allocate_children(kRoot) + number;
    nodes_[at] = old;
    nodes_[at].parent = kRoot;
    for (std::uint32_t slot = old.first; slot != kNone; slot = links_[slot].next) links_[slot].node = at;
    for (std::uint32_t i = 0; i < kChildren; ++i) nodes_[old.child + i].parent = at;
  }
}

template <class S, int kAxes> std::uint32_t CellTree<S, kAxes>::place_of(const Cells& cells) const {
  std::uint32_t at = kRoot;
  while (nodes_[at].child != kNone && fits(cells, nodes_[at].level - 1))
    at = nodes_[at].child + child_of(cells, nodes_[at].level - 1);
  return at;
}
/// Returns the place of a box, and divides full cells for it.
template <class S, int kAxes> std::uint32_t CellTree<S, kAxes>::make_place(const Cells& cells) {
  std::uint32_t at = place_of(cells);
  while (nodes_[at].own >= kMost && nodes_[at].child == kNone && fits(cells, nodes_[at].level - 1)) {
    divide(at);
    at = nodes_[at].child + child_of(cells, nodes_[at].level - 1);
  }
  return at;
}

template <class S, int kAxes> std::uint32_t CellTree<S, kAxes>::allocate_children(std::uint32_t parent) {
  std::uint32_t block = free_;
  if (block != kNone) {
    free_ = nodes_[block].child;
  } else {
    block = top_;
    top_ += kChildren;
    if (nodes_.size() < top_) nodes_.resize(top_);
  }
  for (std::uint32_t i = 0; i < kChildren; ++i)
    nodes_[block + i] = {{}, parent, kNone, kNone, 0, 0, nodes_[parent].level - 1};
  nodes_[parent].child = block;
  ++divided_;
  return block;
}
template <class S, int kAxes> void CellTree<S, kAxes>::free_children(std::uint32_t parent) {
  const std::uint32_t block = nodes_[parent].child;
  nodes_[parent].child = kNone;
  nodes_[block].child = free_;
  free_ = block;
  --divided_;
}

template <class S, int kAxes> void CellTree<S, kAxes>::link(std::uint32_t node, std::uint32_t slot) {
  const std::uint32_t next = nodes_[node].first;
  links_[slot] = {node, next, kNone};
  if (next != kNone) links_[next].previous = slot;
  nodes_[node].first = slot;
  ++nodes_[node].own;
}
template <class S, int kAxes> void CellTree<S, kAxes>::unlink(std::uint32_t slot) {
  const Link& gone = links_[slot];
  if (gone.next != kNone) links_[gone.next].previous = gone.previous;
  if (gone.previous != kNone) links_[gone.previous].next = gone.next;
  else nodes_[gone.node].first = gone.next;
  --nodes_[gone.node].own;
}

template <class S, int kAxes> void CellTree<S, kAxes>::divide(std::uint32_t node) {
  const std::uint32_t block = allocate_children(node);
  const int level = nodes_[block].level;
  std::uint32_t next = kNone;
  for (std::uint32_t slot = nodes_[node].first; slot != kNone; slot = next) {
    next = links_[slot].next;
    const Cells cells = Cells::of(boxes_[slot]);
    if (!fits(cells, level)) continue;
    Node& child = nodes_[block + child_of(cells, level)];
    child.content = child.below == 0 ? boxes_[slot] : merge(child.content, boxes_[slot]);
    ++child.below;
    unlink(slot);
    link(block + child_of(cells, level), slot);
  }
}

/// Moves up the boxes of the children. No child is divided: a divided node has more than kFew boxes below it.
template <class S, int kAxes> void CellTree<S, kAxes>::join(std::uint32_t node) {
  for (std::uint32_t i = 0; i < kChildren; ++i) {
    const std::uint32_t child = nodes_[node].child + i;
    while (nodes_[child].first != kNone) {
      const std::uint32_t slot = nodes_[child].first;
      unlink(slot);
      link(node, slot);
    }
  }
  free_children(node);
}

/// Adds `more` boxes to a node and all above it, and enlarges their contents to contain the box.
template <class S, int kAxes>
void CellTree<S, kAxes>::enclose(std::uint32_t node, const Aabb<S>& box, std::uint32_t more) {
  for (std::uint32_t at = node; at != kNone; at = nodes_[at].parent) {
    if (more == 0 && isostep::contains(nodes_[at].content, box)) return;
    nodes_[at].content = nodes_[at].below == 0 ? box : merge(nodes_[at].content, box);
    nodes_[at].below += more;
  }
}
template <class S, int kAxes> void CellTree<S, kAxes>::leave(std::uint32_t node) {
  for (std::uint32_t at = node; at != kNone; at = nodes_[at].parent) {
    --nodes_[at].below;
    if (nodes_[at].below <= kFew && nodes_[at].child != kNone) join(at);
  }
  loose_ = true;
}

template <class S, int kAxes> void CellTree<S, kAxes>::insert(std::uint32_t slot, const Aabb<S>& box) {
  const Cells cells = Cells::of(box);
  reach_for(cells);
  boxes_.insert(slot, box);
  if (slot >= links_.size()) links_.resize(slot + 1u);
  const std::uint32_t node = make_place(cells);
  link(node, slot);
  enclose(node, box, 1);
}

template <class S, int kAxes> void CellTree<S, kAxes>::update(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(contains(slot));
  const Cells cells = Cells::of(box);
  reach_for(cells);
  boxes_.replace(slot, box);
  const std::uint32_t node = links_[slot].node;
  loose_ = true;
  if (place_of(cells) == node) {
    enclose(node, box, 0);
    return;
  }
  unlink(slot);
  leave(node);
  const std::uint32_t place = make_place(cells);
  link(place, slot);
  enclose(place, box, 1);
}

template <class S, int kAxes> void CellTree<S, kAxes>::remove(std::uint32_t slot) {
  boxes_.remove(slot);
  unlink(slot);
  leave(links_[slot].node);
}

template <class S, int kAxes> void CellTree<S, kAxes>::clear() {
  boxes_.clear();
  free_ = kNone;
  top_ = 0;
  divided_ = 0;
  loose_ = false;
}

template <class S, int kAxes> void CellTree<S, kAxes>::optimise() {
  if (!loose_ || size() == 0) return;
  loose_ = false;
  order_.clear();
  order_.push_back(kRoot);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Node& node = nodes_[order_[i]];
    for (std::uint32_t k = 0; k < kChildren && node.child != kNone; ++k) {
      if (nodes_[node.child + k].below != 0) order_.push_back(node.child + k);
    }
  }
  for (std::size_t i = order_.size(); i-- > 0;) {  // children before parents
    Node& node = nodes_[order_[i]];
    bool any = false;
    const auto take = [&](const Aabb<S>& box) ISO_INLINE_LAMBDA {
      node.content = any ? merge(node.content, box) : box;
      any = true;
    };
    for (std::uint32_t slot = node.first; slot != kNone; slot = links_[slot].next) take(boxes_[slot]);
    for (std::uint32_t k = 0; k < kChildren && node.child != kNone; ++k) {
      if (nodes_[node.child + k].below != 0) take(nodes_[node.child + k].content);
    }
  }
}

template <class S, int kAxes> bool CellTree<S, kAxes>::validate() const {
  if (size() == 0) return true;
  std::uint32_t divided = 0, found = 0;
  for (std::uint32_t slot = boxes_.next(0); slot != Bitset::kNone; slot = boxes_.next(slot + 1u)) {
    const std::uint32_t node = links_[slot].node;
    const std::uint32_t next = links_[slot].next, previous = links_[slot].previous;
    if (place_of(Cells::of(boxes_[slot])) != node) return false;
    if (next != kNone && links_[next].previous != slot) return false;
    if (previous == kNone ? nodes_[node].first != slot : links_[previous].next != slot) return false;
    for (std::uint32_t at = node; at != kNone; at = nodes_[at].parent) {
      if (!isostep::contains(nodes_[at].content, boxes_[slot])) return false;
    }
  }
  std::vector<std::uint32_t> open = {kRoot};
  while (!open.empty()) {
    const Node node = nodes_[open.back()];
    open.pop_back();
    std::uint32_t own = 0, below = node.own;
    for (std::uint32_t slot = node.first; slot != kNone; slot = links_[slot].next) ++own;
    found += own;
    divided += node.child != kNone ? 1u : 0u;
    for (std::uint32_t k = 0; k < kChildren && node.child != kNone; ++k) {
      below += nodes_[node.child + k].below;
      open.push_back(node.child + k);
    }
    if (own != node.own || below != node.below) return false;
  }
  return divided == divided_ && found == size();
}

}  // namespace isostep
