// JointLoads<S>: what measured joints bore in a step, and which of them it broke.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/commands/destruction.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/joints/joint_impulse.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"

namespace isostep {

/// Input:   the JointLoad records; the impulses that the solver adds to impulses().
/// Output:  force and torque in the records' states. Broken joints are destroyed and reported, ascending by the
///          record's slot.
/// Keeps:   nothing from step to step but memory.
template <class S> class JointLoads {
 public:
  ISO_INLINE JointLoads(WorldState<S>& state, const BodyMap<S>& map, Destruction<S>& destruction)
      : state_(state), map_(map), destruction_(destruction) {}

  /// Returns zeros, one for each awake joint, or nothing if no joint is measured. Called before the solver of a step.
  std::span<JointImpulse<S>> impulses();
  /// Measures loads and breaks joints. Call it when the step no longer needs its contacts and joints.
  void update(Events<S>& events);

 private:
  bool measure(const JointLoad<S>& load, JointLoadState<S>& state) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Destruction<S>& destruction_;
  std::vector<JointImpulse<S>> impulses_;  // by awake joint
  std::vector<JointBroke<S>> broken_;
};

#define ISO_JOINT_LOADS_OF(extern, S) extern template class JointLoads<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_JOINT_LOADS_OF)

}  // namespace isostep
