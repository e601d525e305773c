// ChildTree<S>: the children of one shape as a tree of boxes, so that what is near one of many is found without the
// others.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/geometry/closest.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// A tree over the children of one shape, built once. It is a function of the children, so worlds and snapshots with a
/// common shape share it. Boxes are in the body's frame, so it serves all bodies of the shape, wherever they are.
template <class S> class ChildTree {
 public:
  static constexpr std::uint32_t kLeastChildren = 9;  // of fewer, looking at all of them is as fast

  /// `children`: as a world stores them, one or more.
  ChildTree(std::span<const Child<S>> children, Contents<S> contents);

  ISO_INLINE bool has_surfaces() const { return has_surfaces_; }
  /// Returns the index of a child's first leaf: see leaves_of.
  ISO_INLINE std::uint32_t first_leaf(std::uint32_t child) const { return first_leaves_[child]; }
  /// `index` must be in range.
  ISO_INLINE Leaf leaf_at(std::uint32_t index) const {
    const std::size_t after =
        lower_bound(first_leaves_.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return first_leaves_[i] <= index; });
    return {static_cast<std::uint32_t>(after - 1), index - first_leaves_[after - 1]};
  }
  /// Returns the bounds of all children but half-spaces, in the frame that `t` leads to.
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return Turn(t, bounds_).turned(bounds_); }

  /// Calls visit(child) -> bool for children whose bounds at `t` meet `box`, and perhaps for others, in no stated
  /// order. If it returns false, the query ends and returns false.
  template <class Visit> ISO_INLINE bool query(const Transform<S>& t, const Aabb<S>& box, Visit&& visit) const {
    for (const std::uint32_t child : endless_) {
      if (!visit(child)) return false;
    }
    const Turn turn(t, bounds_);
    return tree_.traverse([&](const Aabb<S>& of) ISO_INLINE_LAMBDA { return overlap(turn.turned(of), box); }, visit);
  }
  /// Calls visit(child, max_fraction), like AabbTree::sweep, for the children at `t`.
  template <class Visit> ISO_INLINE void sweep(const Transform<S>& t, const Sweep<S>& sweep, Visit&& visit) const {
    Sweep<S> local = sweep;
    for (const std::uint32_t child : endless_) local.max_fraction = visit(child, local.max_fraction);
    const S slack = slack_of(t, max_abs(bounds_.low) + max_abs(bounds_.high) + max_abs(sweep.origin));
    local.origin = to_local(t, sweep.origin);
    local.displacement = transposed_times(t.rotation, sweep.displacement);
    local.half = transposed_times(absolute(t.rotation), sweep.half) + Vec3<S>{slack, slack, slack};
    tree_.sweep(local, visit);
  }

 private:
  static ISO_INLINE Mat3<Unit<S>> absolute(const Mat3<Unit<S>>& m) {
    return {{abs(m.rows[0]), abs(m.rows[1]), abs(m.rows[2])}};
  }
  /// [m] Returns a bound of the rounding of boxes up to `extent` [m] away from the frame's origin.
  static ISO_INLINE S slack_of(const Transform<S>& t, S extent) {
    return detail::gap_noise(extent + max_abs(t.position)) * S(4);
  }
  /// Turns boxes of the tree into the frame that `t` leads to.
  struct Turn {
    Transform<S> t;
    Mat3<Unit<S>> absolutes;
    Vec3<S> slack;

    ISO_INLINE Turn(const Transform<S>& to, const Aabb<S>& all) : t(to), absolutes(absolute(to.rotation)) {
      const S s = slack_of(to, max_abs(all.low) + max_abs(all.high));
      slack = {s, s, s};
    }
    ISO_INLINE Aabb<S> turned(const Aabb<S>& box) const {
      const Vec3<S> half = (box.high - box.low) * S(0.5), centre = to_world(t, box.low + half);
      return Aabb<S>::around(centre, absolutes * half + slack);
    }
  };

  AabbTree<S> tree_;  // of all but half-spaces
  Aabb<S> bounds_;    // around it
  std::vector<std::uint32_t> endless_;
  std::vector<std::uint32_t> first_leaves_;
  bool has_surfaces_ = false;
};

/// Returns the leaf with that index among a shape's children. `tree` is their tree, or null.
template <class S>
ISO_INLINE Leaf leaf_at(const ChildTree<S>* tree, std::span<const Child<S>> children, Contents<S> contents,
                        std::uint32_t index) {
  return tree != nullptr ? tree->leaf_at(index) : leaf_at(children, contents, index);
}

#define ISO_CHILD_TREE_OF(extern, S) extern template class ChildTree<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CHILD_TREE_OF)

}  // namespace isostep
