// AskedShape: a shape to ask a world with, one of its own or a primitive.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/query_types.hpp"

namespace isostep::detail {

/// A shape to query with, placed in the world.
template <class S> struct AskedShape {
  Primitive<S> primitive;
  const void* content;  // of its blob
  Pose<S> pose;         // of the primitive's frame, world

  ISO_INLINE ShapeView<S> view() const { return {primitive, content}; }
};

template <class S>
FaultReport fault_of_shape(const WorldState<S>& state, const QueryShape<S>& shape, const Pose<S>& pose);
/// Returns the placed shape, which fault_of_shape() has accepted.
template <class S> AskedShape<S> asked_of(const BodyMap<S>& map, const QueryShape<S>& shape, const Pose<S>& pose);
/// [m] Returns how far a shape of the world reaches from its frame's origin along a direction.
template <class S>
S reach_of(const BodyMap<S>& map, ShapeId shape, const Quat<Unit<S>>& orientation, Vec3<Unit<S>> along);

}  // namespace isostep::detail

namespace isostep {

#define ISO_ASKED_SHAPE_OF(extern, S)                                                                                 \
  extern template FaultReport detail::fault_of_shape<S>(const WorldState<S>&, const QueryShape<S>&, const Pose<S>&);  \
  extern template detail::AskedShape<S> detail::asked_of<S>(const BodyMap<S>&, const QueryShape<S>&, const Pose<S>&); \
  extern template S detail::reach_of<S>(const BodyMap<S>&, ShapeId, const Quat<Unit<S>>&, Vec3<Unit<S>>);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ASKED_SHAPE_OF)

}  // namespace isostep
