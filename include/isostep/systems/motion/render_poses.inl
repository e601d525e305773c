// Bodies of render_poses.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/systems/motion/render_poses.hpp"

namespace isostep {

template <class S> void RenderPoses<S>::keep_start() {
  start_poses_.resize(state_.awake.states.size());
  start_slots_.resize(start_poses_.size());
  for (std::size_t i = 0; i < start_poses_.size(); ++i) {
    start_poses_[i] = {state_.awake.states[i].centre, state_.awake.states[i].orientation};
    start_slots_[i] = state_.awake.states[i].slot;
  }
}

template <class S> void RenderPoses<S>::start_here(const BodyState<S>& state) {
  const std::size_t at = lower_bound(start_slots_.size(), [&](std::size_t i) { return start_slots_[i] < state.slot; });
  if (at < start_slots_.size() && start_slots_[at] == state.slot) start_poses_[at] = {state.centre, state.orientation};
}

template <class S> const std::vector<RenderPose>& RenderPoses<S>::fill(float alpha) {
  poses_.clear();
  // A body created or woken since the last step has no earlier pose and is drawn where it is. Both lists ascend.
  std::size_t start = 0;
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const std::uint32_t slot = state_.awake.states[i].slot;
    while (start < start_slots_.size() && start_slots_[start] < slot) ++start;
    const bool known = start < start_slots_.size() && start_slots_[start] == slot;
    add(state_.awake.states[i], state_.awake.properties[i], known ? &start_poses_[start] : nullptr, alpha);
  }
  for (const std::shared_ptr<const SleepingIsland<S>>& island : state_.sleeping) {
    for (std::size_t i = 0; i < island->bodies.states.size(); ++i)
      add(island->bodies.states[i], island->bodies.properties[i], nullptr, alpha);
  }
  return poses_;
}

/// Interpolates positions linearly, and orientations linearly with normalisation. `start` is null if there is none.
template <class S>
void RenderPoses<S>::add(const BodyState<S>& state, const BodyProperties<S>& body, const Pose<S>* start, float alpha) {
  const auto number = [](auto x) { return static_cast<float>(to_double(x)); };
  const Pose<S> now = origin_pose(state, body);
  BodyState<S> then_state = state;
  if (start != nullptr) {
    then_state.centre = start->position;
    then_state.orientation = start->orientation;
  }
  const Pose<S> then = origin_pose(then_state, body);
  const auto blend = [&](auto from, auto to) { return number(from) + alpha * (number(to) - number(from)); };
  const Quat<Unit<S>> p = then.orientation, q = now.orientation;
  const float sign =
      number(p.x) * number(q.x) + number(p.y) * number(q.y) + number(p.z) * number(q.z) + number(p.w) * number(q.w) < 0
          ? -1.0f
          : 1.0f;
  const auto turn = [&](auto from, auto to) {
    return sign * number(from) + alpha * (number(to) - sign * number(from));
  };
  RenderPose pose = {state_.body_slots.template id_of<BodyId>(state.slot),
                     {blend(then.position.x, now.position.x), blend(then.position.y, now.position.y),
                      blend(then.position.z, now.position.z)},
                     {turn(p.x, q.x), turn(p.y, q.y), turn(p.z, q.z), turn(p.w, q.w)}};
  float* o = pose.orientation;
  const float size = sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2] + o[3] * o[3]);
  for (int i = 0; i < 4; ++i) o[i] /= size;
  poses_.push_back(pose);
}

}  // namespace isostep
