// The two poses of a body, of its origin and of its centre of mass, from one another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body.hpp"

namespace isostep {

/// A body's origin is its centre less the centre's place in the body.
template <class S> Pose<S> origin_pose(const BodyState<S>& state, const BodyProperties<S>& body) {
  if (body.local_centre == Vec3<S>::zero()) return {state.centre, state.orientation};
  return {state.centre - to_matrix(state.orientation) * body.local_centre, state.orientation};
}
/// The inverse: where the centre of mass is, axes as the body's, of a body with its origin there.
template <class S> Pose<S> centre_pose(const Pose<S>& origin, Vec3<S> local_centre) {
  return {origin.position + to_matrix(origin.orientation) * local_centre, origin.orientation};
}

}  // namespace isostep
