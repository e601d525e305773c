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
/// [m] Contacts are found this far ahead of touching, so that the solver sees them before they overlap.
template <class S> inline constexpr S kSpeculativeDistance = S(0.02);
/// Returns the leaves of a child, as contacts count them.
template <class S> LeafRange leaves_of_part(const BodyFrame<S>& frame, std::uint32_t index);
}  // namespace detail

template <class S> BodyFrame<S> frame_at(const BodyMap<S>& map, Location at);

/// Calls visit(child_a, child_b) for all pairs of parts whose bounds meet within the margin, a single pair in any case,
/// in order of indices. Stops and returns false if `visit` returns false, or if `looks`, which counts down, reaches 0.
/// It looks at all pairs: for bodies of few parts.
template <class S, class Visit>
ISO_INLINE bool visit_parts(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                            Visit&& visit);

/// visit_parts() for leaves, if one of the bodies has surfaces or many parts. Of a convex part and a surface it visits
/// the triangles whose boxes meet the part's. The order follows from the shapes.
template <class S, class Visit>
ISO_INLINE bool visit_leaves(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                             Visit&& visit);

/// Collides leaf i of body a with leaf j of body b, see collide_leaves().
template <class S>
void collide_parts(CollidePolyhedra<S> polyhedra, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                   std::uint32_t j, S margin, Manifold<S>& out);

/// The relation of two parts.
enum class PartMeeting {
  none,   // their filters or flags keep them apart
  solid,  // they press on each other, where one of the bodies is dynamic
  sensed  // one of them is a sensor
};
/// Returns the meeting of leaf i of body a and leaf j of body b. The broad phase pairs their bodies.
template <class S>
PartMeeting meeting_of(const BodyMap<S>& map, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                       std::uint32_t j);
/// Returns true if leaf i is a sensor's.
template <class S> bool is_sensor_leaf(const BodyFrame<S>& body, std::uint32_t i);

/// Calls visit(i, j, meeting) -> bool for the leaves of two bodies whose bounds meet within the margin and whose
/// meeting is not `none`, until it returns false.
template <class S, class Visit>
void visit_meetings(const BodyMap<S>& map, const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, Visit&& visit);

/// Returns the material of leaf i: its part's own, else `own`, the body's. A triangle that its surface's table lists
/// takes friction and restitution from there. It has one coefficient of friction and is of no kind.
template <class S> Material<S> material_of_leaf(const BodyFrame<S>& body, std::uint32_t i, const Material<S>& own);

/// The parts that bodies_touch() looks at: all, sensors too, or solid ones alone. It returns true if two bodies have a
/// contact, or are no further from each other than `margin` [m].
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
