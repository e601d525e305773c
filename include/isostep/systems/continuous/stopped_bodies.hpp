// StoppedBodies<S>: puts bodies back to where they are stopped.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/continuous/mover.hpp"

namespace isostep {

/// Input:   an awake body by its index, and the end of its motion.
/// Output:  its pose and velocity, its fat box; the broad phase knows of it. Velocities stay, for the next step finds
///          the contact, but for what gravity did on the way left out, and for that of a middle into what is fixed.
/// Keeps:   nothing.
template <class S> class StoppedBodies {
 public:
  ISO_INLINE StoppedBodies(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// `moving`: dynamic bodies stop it.
  void stop(std::uint32_t index, const MotionCut<S>& cut, bool moving);
  /// The pose alone: place() is to follow.
  void put_at(std::uint32_t index, const Pose<S>& pose);
  /// Renews the fat box.
  void place(std::uint32_t index);

 private:
  void stop_middle(BodyState<S>& state, const MotionCut<S>& cut, bool moving) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
};

}  // namespace isostep
