// The two poses of a body, of its origin and of its centre of mass, from one another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body.hpp"

namespace isostep {

/// Returns the pose of the body's origin: the centre of mass less its place in the body.
template <class S> Pose<S> origin_pose(const BodyState<S>& state, const BodyProperties<S>& body) {
  if (body.local_centre == Vec3<S>::zero()) return {state.centre, state.orientation};
  return {state.centre - to_matrix(state.orientation) * body.local_centre, state.orientation};
}
/// The inverse: returns the pose of the centre of mass, with the body's axes, of a body with this origin.
template <class S> Pose<S> centre_pose(const Pose<S>& origin, Vec3<S> local_centre) {
  return {origin.position + to_matrix(origin.orientation) * local_centre, origin.orientation};
}

}  // namespace isostep
