// StoppedMechanisms<S>: what joints tie together stops together.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/systems/continuous/first_impacts.hpp"
#include "isostep/systems/continuous/joined_bodies.hpp"
#include "isostep/systems/continuous/stopped_bodies.hpp"

namespace isostep {

/// Input:   the movers, cut to where each is stopped, and the joints.
/// Output:  the poses of all bodies of a mechanism with a stopped mover.
/// Keeps:   nothing but memory.
/// Method:  each joint moves by that fraction of its motion which the first stopped body did of its way. Bodies follow
///          from the joints, from the heaviest outwards, but none deviates from its own way by more than the length of
///          that way. Points that joints hold together are closed.
template <class S> class StoppedMechanisms {
 public:
  ISO_INLINE StoppedMechanisms(const WorldState<S>& state, const BodyMap<S>& map, const StepMotion<S>& motion,
                               FastBodies<S>& fast, FirstImpacts<S>& impacts, StoppedBodies<S>& bodies)
      : state_(state),
        map_(map),
        motion_(motion),
        fast_(fast),
        impacts_(impacts),
        bodies_(bodies),
        joined_bodies_(state, map) {}

  void update();

 private:
  using Link = typename JoinedBodies<S>::Link;
  /// The body that limits how far its whole mechanism moves.
  struct Leader {
    std::uint32_t body;
    Unit<S> fraction;  // [1] of the step
  };
  /// The poses of one end of a joint: at the start of the step, after the solver, and now.
  struct Carriage {
    Pose<S> start, end, now;
  };
  struct Obstruction {
    std::uint32_t body;
    Unit<S> part;  // [1] of its way to where it was placed
  };

  void stop(std::span<const std::uint32_t> mechanism);
  void keep_ends(std::span<const std::uint32_t> mechanism);
  Leader leader_of(std::span<const std::uint32_t> mechanism) const;
  bool meets_carrier(std::span<const std::uint32_t> mechanism) const;
  void place_tree(std::span<const Link> tree, Unit<S> fraction, bool closes);
  Pose<S> own_way(std::uint32_t body, Unit<S> fraction);
  Pose<S> joined_pose(const Link& link, Unit<S> fraction, bool closes);
  bool turns_far(std::uint32_t slot) const;
  Carriage carriage_of(std::uint32_t slot, const Pose<S>& frame) const;
  Pose<S> held_by_locks(std::uint32_t index, const Pose<S>& there, const Pose<S>& frame) const;
  Unit<S> free_part(std::uint32_t body);
  Obstruction worst_of(std::span<const Link> tree);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const StepMotion<S>& motion_;
  FastBodies<S>& fast_;
  FirstImpacts<S>& impacts_;
  StoppedBodies<S>& bodies_;
  JoinedBodies<S> joined_bodies_;
  std::vector<Pose<S>> ends_;  // by index among the awake bodies: where the solver left those of the mechanism
};

}  // namespace isostep
