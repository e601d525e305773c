// Bodies of substep_bodies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/forces/substep_bodies.hpp"

namespace isostep {

template <class S> void SubstepBodies<S>::begin_substep(const SolverBodies<S>& bodies, std::int32_t rate) {
  const std::int32_t hz = state_.settings.hz;
  bodies_ = &bodies;
  clock_ = {state_.tick, hz, rate, divide_to<Step<S>>(S(1), S(rate)), substep_, static_cast<std::uint32_t>(rate / hz)};
}

template <class S> BodyEnd<S> SubstepBodies<S>::end(std::uint32_t row, Vec3<S> centre, Vec3<S> arm) const {
  const MotionRow<Velocity<S>>& v = velocity(row);
  return {row, centre + arm, arm, convert<S>(v.linear) + cross(convert<S>(v.angular), arm)};
}
template <class S> BodyEnd<S> SubstepBodies<S>::end_of(std::uint32_t row, Vec3<S> arm) const {
  return end(row, state(row).centre, arm);
}
template <class S> BodyEnd<S> SubstepBodies<S>::end_at(BodyId body, Vec3<S> local) const {
  if (!body) return {0, local, Vec3<S>::zero(), Vec3<S>::zero()};
  const Location at = map_.location(body.slot);
  const BodyState<S>& state = map_.state_at(at);
  const Vec3<S> arm = rotate(state.orientation, local - map_.properties_at(at).local_centre);
  return end(map_.row_of(body.slot), state.centre, arm);
}
template <class S> BodyEnd<S> SubstepBodies<S>::centre_of(BodyId body) const {
  return end_at(body, map_.properties_at(map_.location(body.slot)).local_centre);
}

}  // namespace isostep
