// RenderPoses<S>: poses for drawing, between the last two steps.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_poses.hpp"
#include "isostep/store/state.hpp"
#include "isostep/store/views.hpp"

namespace isostep {

/// Input:   the state as a step begins, and later.
/// Output:  poses of all bodies that move or sleep.
/// Keeps:   the poses of the awake bodies at the start of the last step.
template <class S> class RenderPoses {
 public:
  ISO_INLINE explicit RenderPoses(const WorldState<S>& state) : state_(state) {}

  /// Keeps the poses. Called at the start of a step.
  void keep_start();
  /// The poses of the centres of the bodies that were awake at the start of the step, in their order.
  ISO_INLINE std::span<const Pose<S>> start() const { return start_poses_; }
  /// Draws a body where a command puts it, without interpolation from the former place of its slot.
  void start_here(const BodyState<S>& state);
  /// Forgets the old poses, because the state was replaced: bodies are drawn where they are.
  ISO_INLINE void forget() {
    start_poses_.clear();
    start_slots_.clear();
  }

  /// Returns the interpolated poses. `alpha` 0: the start of the last step; 1: now.
  const std::vector<RenderPose>& fill(float alpha);

  template <class Visit> void visit_scratch(const Visit& visit) {
    visit("start_poses", start_poses_);
    visit("start_slots", start_slots_);
  }

 private:
  void add(const BodyState<S>& state, const BodyProperties<S>& body, const Pose<S>* start, float alpha);

  const WorldState<S>& state_;
  std::vector<Pose<S>> start_poses_;
  std::vector<std::uint32_t> start_slots_;  // of the same bodies, ascending
  std::vector<RenderPose> poses_;
};

#define ISO_RENDER_POSES_OF(extern, S) extern template class RenderPoses<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_RENDER_POSES_OF)

}  // namespace isostep
