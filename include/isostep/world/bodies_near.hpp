// BodiesNear<S>: the bodies of one place, for many queries about it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/collision/query/shape_cast.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

namespace detail {
/// [m] What a plane parts by so much, rounding brings no nearer.
template <class S> inline constexpr S kClearlyParted = S(0x1p-9);
}  // namespace detail

/// What a filter sees in a region, as Queries::find_bodies_near leaves it: for one shape that does not turn, until a
/// body moves. A query that stays within the region meets these and no others, so its answer is the one that the broad
/// phase would lead to; and it need not meet those that a plane of a cast before still parts from the shape.
template <class S> class BodiesNear {
 public:
  struct Body {
    std::uint32_t slot;
    Aabb<S> box;          // [m] around it, world
    Transform<S> placed;  // its origin, world
    bool is_whole;        // one convex part
    /// Of a body that is whole, from the shape that asks: a proof that casts leave, so that others are spared.
    mutable Parting<S> parting;
  };
  ISO_INLINE void begin(const Aabb<S>& region) {
    region_ = region;
    bodies_.clear();
  }
  ISO_INLINE void add(const Body& body) { bodies_.push_back(body); }
  ISO_INLINE const Aabb<S>& region() const { return region_; }

  ISO_INLINE bool holds(const Aabb<S>& box) const { return contains(region_, box); }
  /// Whether all that the sweep touches is here.
  ISO_INLINE bool holds(const Sweep<S>& sweep) const { return holds(detail::SweepTest<S>(sweep, region_).reach); }

  /// visit(body) for each whose box overlaps, in the order in which they were added.
  template <class Visit> ISO_INLINE void query(const Aabb<S>& box, const Visit& visit) const {
    for (const Body& body : bodies_) {
      if (overlap(body.box, box)) visit(body);
    }
  }
  /// As AabbTree::sweep: visit(body, max_fraction) -> the new one.
  template <class Visit> ISO_INLINE void sweep(const Sweep<S>& sweep, const Visit& visit) const {
    detail::SweepTest<S> test(sweep, region_);
    Unit<S> fraction = sweep.max_fraction;
    for (const Body& body : bodies_) {
      if (!test.touches(body.box)) continue;
      const Unit<S> shorter = visit(body, fraction);
      if (shorter < fraction) test.shorten(fraction = shorter);
    }
  }

  std::vector<std::uint32_t> slots, scratch;  // memory of the search

 private:
  Aabb<S> region_;  // [m] world
  std::vector<Body> bodies_;
};

}  // namespace isostep
