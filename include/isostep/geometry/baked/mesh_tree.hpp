// MeshTree: a tree of boxes over triangles, four children a node, in integers.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/geometry/baked/mesh_point.hpp"

namespace isostep {

/// Bounds are 15 bits of the mesh's box an axis, in lanes of 16: one subtraction of words compares four of them.
/// A child is a node, or a leaf: kLeaf | count << kCountShift | its first place in the order of the triangles.
struct MeshNode {
  static constexpr std::uint32_t kLeaf = 1u << 31, kCountShift = 24, kFirstMask = (1u << 24) - 1u;
  static constexpr std::uint32_t kNoChild = kLeaf;  // a leaf of no triangles

  std::uint64_t low[3], high[3];  // lane i, bits 16 i and up, is of child i
  std::uint32_t children[4];
};
static_assert(sizeof(MeshNode) == 64);

/// A tree built from the boxes alone: it splits by surface area (MacDonald and Booth 1990) over 16 bins while a node
/// has many triangles, at the median when it has few or when the tree would become too deep.
class MeshTree {
 public:
  static constexpr std::uint32_t kLeafTriangles = 6;
  static constexpr std::uint32_t kMaxTriangles = 1u << 22;
  /// The most levels of nodes. 10 suffice for kMaxTriangles; the others are for uneven splits.
  static constexpr int kLevels = 16;
  /// Returns how many triangles a tree of `levels` levels can hold.
  static ISO_INLINE constexpr std::uint64_t capacity(int levels) {
    return std::uint64_t{kLeafTriangles} << (2 * levels);
  }
  /// A node leaves three of its children waiting and continues with the fourth.
  static constexpr int kStack = 3 * kLevels + 1;

  // These are what the compiler would make, but without weak functions in the files that hold trees.
  ISO_INLINE MeshTree() = default;
  ISO_INLINE MeshTree(const MeshTree&) = default;
  ISO_INLINE MeshTree(MeshTree&&) = default;
  ISO_INLINE MeshTree& operator=(const MeshTree&) = default;
  ISO_INLINE MeshTree& operator=(MeshTree&&) = default;
  ISO_INLINE ~MeshTree() = default;

  /// Builds a tree over 1 to kMaxTriangles boxes, inside the range of MeshPoint. The tree has at most `levels`, 1 to
  /// kLevels, whose capacity is not less than the number of boxes.
  static MeshTree build(std::span<const MeshBox> boxes, int levels = kLevels);

  ISO_INLINE const MeshBox& bounds() const { return bounds_; }
  ISO_INLINE std::span<const MeshNode> nodes() const { return nodes_; }
  /// The triangles in the order of the leaves.
  ISO_INLINE std::span<const std::uint32_t> order() const { return order_; }
  /// Renames triangle i of the leaves to ids[i]; ids ascend.
  void rename(std::span<const std::uint32_t> ids);
  std::size_t memory() const;

  /// Calls visit(triangle) for all triangles of the leaves whose bounds touch the box. Ends when visit returns false.
  template <class Visit> ISO_INLINE bool query(const MeshBox& box, Visit&& visit) const {
    Lanes lanes;
    if (!lanes_of(box, lanes)) return true;
    std::uint32_t stack[kStack];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::uint32_t child = stack[--size];
      if (child & MeshNode::kLeaf) {
        if (!visit_leaf(child, visit)) return false;
        continue;
      }
      const MeshNode& node = nodes_[child];
      const std::uint64_t touching = lanes.touching(node);
      for (int lane = 3; lane >= 0; --lane) {
        if (touching >> (16 * lane + 15) & 1u) stack[size++] = node.children[lane];
      }
    }
    return true;
  }

  /// Calls visit(triangle) for all triangles of leaves whose boxes overlaps() accepts. Ends when visit returns false.
  template <class Overlaps, class Visit> ISO_INLINE bool traverse(Overlaps&& overlaps, Visit&& visit) const {
    return traverse_in_order([](std::uint32_t node, std::uint32_t* stack, int& size)
                                 ISO_INLINE_LAMBDA { push(node, stack, size); },
                             overlaps, visit);
  }
  /// traverse() that visits the children of a node in the order in which their boxes begin along `way`, whose
  /// components are below 2^32.
  template <class Overlaps, class Visit>
  ISO_INLINE bool traverse(GridVector way, Overlaps&& overlaps, Visit&& visit) const {
    return traverse_in_order([&](std::uint32_t node, std::uint32_t* stack, int& size)
                                 ISO_INLINE_LAMBDA { push_along(way, node, stack, size); },
                             overlaps, visit);
  }

 private:
  friend class MeshTreeBuilder;

  template <class Push, class Overlaps, class Visit>
  ISO_INLINE bool traverse_in_order(const Push& push_children, Overlaps&& overlaps, Visit&& visit) const {
    std::uint32_t stack[kStack];  // 4 node + lane
    int size = 0;
    if (nodes_.empty() || !overlaps(bounds_)) return true;
    push_children(0, stack, size);
    while (size > 0) {
      const std::uint32_t top = stack[--size], lane = top % 4;
      const MeshNode& node = nodes_[top / 4];
      const std::uint32_t child = node.children[lane];
      if (child == MeshNode::kNoChild || !overlaps(box_of(node, lane))) continue;
      if (!(child & MeshNode::kLeaf)) push_children(child, stack, size);
      else if (!visit_leaf(child, visit)) return false;
    }
    return true;
  }

  /// A box in the lanes of nodes, all four alike.
  struct Lanes {
    static constexpr std::uint64_t kTops = 0x8000800080008000u;

    std::uint64_t low[3], high[3];

    /// The top bit of each lane is set if the child's bounds and the box have a point in common. A lane with its top
    /// bit set, less 15 bits, borrows nothing from the next and keeps its top bit exactly if it is not less.
    ISO_INLINE std::uint64_t touching(const MeshNode& node) const {
      std::uint64_t all = kTops;
      for (int axis = 0; axis < 3; ++axis) {
        all &= ((high[axis] | kTops) - node.low[axis]) & ((node.high[axis] | kTops) - low[axis]);
      }
      return all;
    }
  };

  /// Puts a box into lanes. Returns false when the box misses all triangles, or is empty.
  ISO_INLINE bool lanes_of(const MeshBox& box, Lanes& lanes) const {
    if (nodes_.empty() || !bounds_.touches(box)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (box.low[axis] > box.high[axis]) return false;
      lanes.low[axis] = every_lane(axis, box.low[axis] < bounds_.low[axis] ? bounds_.low[axis] : box.low[axis]);
      lanes.high[axis] = every_lane(axis, box.high[axis] > bounds_.high[axis] ? bounds_.high[axis] : box.high[axis]);
    }
    return true;
  }
  /// Both ends of both boxes are rounded down. That preserves order, so no touching boxes are missed.
  ISO_INLINE std::uint64_t every_lane(int axis, std::int64_t v) const { return 0x0001000100010001u * cell(axis, v); }
  ISO_INLINE std::uint64_t cell(int axis, std::int64_t v) const {
    return static_cast<std::uint64_t>(v - bounds_.low[axis]) >> shift_[axis];
  }
  ISO_INLINE MeshBox box_of(const MeshNode& node, std::uint32_t lane) const {
    MeshBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto low = static_cast<std::int64_t>(node.low[axis] >> (16 * lane) & 0x7fffu);
      const auto high = static_cast<std::int64_t>(node.high[axis] >> (16 * lane) & 0x7fffu);
      box.low[axis] = bounds_.low[axis] + (low << shift_[axis]);
      const std::int64_t end = bounds_.low[axis] + ((high + 1) << shift_[axis]) - 1;
      box.high[axis] = end < bounds_.high[axis] ? end : bounds_.high[axis];
    }
    return box;
  }
  template <class Visit> ISO_INLINE bool visit_leaf(std::uint32_t leaf, Visit&& visit) const {
    const std::uint32_t first = leaf & MeshNode::kFirstMask;
    const std::uint32_t count = (leaf & ~MeshNode::kLeaf) >> MeshNode::kCountShift;
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (!visit(order_[i])) return false;
    }
    return true;
  }
  static ISO_INLINE void push(std::uint32_t node, std::uint32_t* stack, int& size) {
    for (std::uint32_t lane = 4; lane-- > 0;) stack[size++] = 4 * node + lane;
  }
  ISO_INLINE void push_along(GridVector way, std::uint32_t node, std::uint32_t* stack, int& size) const {
    const std::int64_t along[3] = {way.x, way.y, way.z};
    std::int64_t begins[4];
    std::uint32_t* const top = stack + size;  // the furthest first: the last is taken first
    for (std::uint32_t lane = 0; lane < 4; ++lane) {
      begins[lane] = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const std::uint64_t* const side = along[axis] < 0 ? nodes_[node].high : nodes_[node].low;
        const auto cells = static_cast<std::int64_t>(side[axis] >> (16 * lane) & 0x7fffu);
        begins[lane] += (cells << shift_[axis]) * along[axis];
      }
      std::uint32_t place = lane;
      for (; place > 0 && begins[top[place - 1] % 4] <= begins[lane]; --place) top[place] = top[place - 1];
      top[place] = 4 * node + lane;
    }
    size += 4;
  }

  MeshBox bounds_ = {};
  int shift_[3] = {};            // of each axis, from steps to the 15 bits of a node
  std::vector<MeshNode> nodes_;  // the first is the root; parents come before children
  std::vector<std::uint32_t> order_;
};

}  // namespace isostep
