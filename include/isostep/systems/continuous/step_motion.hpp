// StepMotion<S>: how awake bodies moved in a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "isostep/store/body_map.hpp"
#include "isostep/systems/continuous/mover.hpp"

namespace isostep {

/// Input:   the state after the solver; the centres' poses as the step began.
/// Output:  the path of an awake body, and the measures that its sweep needs.
/// Keeps:   nothing.
template <class S> class StepMotion {
 public:
  ISO_INLINE StepMotion(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  ISO_INLINE void begin(std::span<const Pose<S>> start) { start_ = start; }
  ISO_INLINE const Pose<S>& start(std::size_t index) const { return start_[index]; }
  ISO_INLINE Pose<S> now(std::size_t index) const {
    return {state_.awake.states[index].centre, state_.awake.states[index].orientation};
  }
  ISO_INLINE bool is_bullet(std::size_t index) const {
    return (state_.awake.properties[index].flags & body_flag::kBullet) != 0;
  }
  /// Returns true if the body is dynamic and has contacts.
  bool may_move(std::size_t index) const;
  /// Returns true if the body did not move.
  bool is_at_rest(Location at) const;
  BodyPath<S> path_of(std::size_t index) const;
  Mover<S> measure(std::size_t index) const { return measure(index, path_of(index)); }
  Mover<S> measure(std::size_t index, const BodyPath<S>& path) const;

 private:
  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::span<const Pose<S>> start_;  // for one update
};

}  // namespace isostep
