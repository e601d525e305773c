// MoveTargets<S>: carries kinematic bodies to where move_to says.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/math/shortened.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/store/body_map.hpp"

namespace isostep {

namespace detail {
/// Returns the pose of the centre of mass of a body whose origin is at `pose`.
template <class S> ISO_INLINE Pose<S> centre_at(const Pose<S>& pose, Vec3<S> local_centre) {
  return centre_pose({pose.position, normalise(pose.orientation)}, local_centre);
}
}  // namespace detail

/// Input:   the state as a step begins, with its moves; after its sub-steps; as it ends.
/// Output:  velocities that lead to the targets; poses at the targets; zero velocities, and those moves removed.
/// Keeps:   the moves of the current step.
template <class S> class MoveTargets {
 public:
  ISO_INLINE MoveTargets(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void begin_step();
  void arrive();
  void end_step();

 private:
  struct Move {
    std::uint32_t body;  // its slot
    Pose<S> goal;        // of the centre of mass
    bool reaches;
    std::uint32_t locks;  // of the body: none holds it in this step
  };
  BodyState<S>& state_of(const Move& move) { return state_.awake.states[map_.location(move.body).index]; }
  bool start(BodyState<S>& state, const Pose<S>& goal) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<Move> moves_;
};

#define ISO_MOVE_TARGETS_OF(extern, S) extern template class MoveTargets<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_MOVE_TARGETS_OF)

}  // namespace isostep
