// Questions about one joint: where it stands, and how far it is from where it belongs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"

namespace isostep::detail {

// What World's calls of the same names return: 0 of an id that names nothing.
template <class S> S joint_error(const BodyMap<S>& map, JointId joint);
template <class S> S joint_position(const BodyMap<S>& map, JointId joint);
template <class S> S joint_position(const WorldState<S>& state, const BodyMap<S>& map, JointId joint, JointAxis axis);

}  // namespace isostep::detail

namespace isostep {

#define ISO_JOINT_QUERIES_OF(extern, S)                                    \
  extern template S detail::joint_error<S>(const BodyMap<S>&, JointId);    \
  extern template S detail::joint_position<S>(const BodyMap<S>&, JointId); \
  extern template S detail::joint_position<S>(const WorldState<S>&, const BodyMap<S>&, JointId, JointAxis);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_JOINT_QUERIES_OF)

}  // namespace isostep
