// Bodies as the narrow phase sees them: their frames, the pairs of their parts, and what two parts give when they meet.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/store/body_map.hpp"

namespace isostep {

namespace detail {
/// [m] contacts are found this far ahead of touching, so that the solver sees them before they overlap.
template <class S> inline constexpr S kSpeculativeDistance = S(0.02);
/// Leaves of a child, as contacts count them.
template <class S> LeafRange leaves_of_part(const BodyFrame<S>& frame, std::uint32_t index);
}  // namespace detail

template <class S> BodyFrame<S> frame_at(const BodyMap<S>& map, Location at);

/// visit(child_a, child_b) for every two parts whose bounds meet within the margin, in order of their indices, until it
/// returns false or `looks`, which counts down, are used up. False: that came before the end. Looks at all of them: for
/// bodies of few parts.
template <class S, class Visit>
ISO_INLINE bool visit_parts(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                            Visit&& visit);

/// visit_parts() of leaves, where one of the bodies has surfaces or many parts: of a convex part and a triangle those
/// whose boxes meet. The order follows from the shapes.
template <class S, class Visit>
ISO_INLINE bool visit_leaves(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                             Visit&& visit);

/// Leaf i of body a and leaf j of body b, as collide_leaves() has them.
template <class S>
void collide_parts(CollidePolyhedra<S> polyhedra, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                   std::uint32_t j, S margin, Manifold<S>& out);

/// What two parts are to each other.
enum class PartMeeting {
  none,   // their filters or flags keep them apart
  solid,  // they press on each other, where one of the bodies is dynamic
  sensed  // one of them is a sensor
};
/// The meeting of leaf i of body a and leaf j of body b, whose bodies the broad phase pairs.
template <class S>
PartMeeting meeting_of(const BodyMap<S>& map, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                       std::uint32_t j);
/// True if leaf i is a sensor's.
template <class S> bool is_sensor_leaf(const BodyFrame<S>& body, std::uint32_t i);

/// visit(i, j, meeting) -> bool for the leaves of two bodies whose bounds meet within the margin and that are something
/// to each other, until it returns false.
template <class S, class Visit>
void visit_meetings(const BodyMap<S>& map, const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, Visit&& visit);

/// The material of leaf i: its part's own, else `own`, the body's, but where the leaf is a triangle whose number stands
/// in its surface's table. That has one coefficient of friction and is of no kind.
template <class S> Material<S> material_of_leaf(const BodyFrame<S>& body, std::uint32_t i, const Material<S>& own);

/// Whether two bodies have a contact, or are no further from each other than that [m]; by parts that are sensors too,
/// or by others alone.
enum class ByParts { any, solid };
template <class S>
bool bodies_touch(const BodyMap<S>& map, std::uint32_t slot_a, std::uint32_t slot_b, ByParts by,
                  S margin = detail::kSpeculativeDistance<S>);

#define ISO_BODY_FRAMES_OF(extern, S)                                                      \
  extern template BodyFrame<S> frame_at<S>(const BodyMap<S>&, Location);                   \
  extern template LeafRange detail::leaves_of_part<S>(const BodyFrame<S>&, std::uint32_t); \
  extern template bool bodies_touch<S>(const BodyMap<S>&, std::uint32_t, std::uint32_t, ByParts, S);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BODY_FRAMES_OF)

}  // namespace isostep
