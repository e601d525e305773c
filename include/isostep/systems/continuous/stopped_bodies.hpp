// StoppedBodies<S>: puts bodies back to where they are stopped.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/continuous/mover.hpp"

namespace isostep {

/// Input:   an awake body by its index, and the end of its motion.
/// Output:  its pose and velocity, fat box and proxy. Its velocity stays, since the next step finds the contact, except
///          for what gravity added on the way left out, and the speed of a stopped middle into a fixed body.
/// Keeps:   nothing.
template <class S> class StoppedBodies {
 public:
  ISO_INLINE StoppedBodies(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  /// `moving`: a dynamic body stopped it.
  void stop(std::uint32_t index, const MotionCut<S>& cut, bool moving);
  /// Sets the pose only. Call place() afterwards.
  void put_at(std::uint32_t index, const Pose<S>& pose);
  /// Renews the fat box and the proxy.
  void place(std::uint32_t index);

 private:
  void stop_middle(BodyState<S>& state, const MotionCut<S>& cut, bool moving) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
};

}  // namespace isostep
