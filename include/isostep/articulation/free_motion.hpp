// FreeMotion<S>: the momentum of a tree that nothing holds, carried exactly from sub-step to sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulated_dynamics.hpp"

namespace isostep::detail {

/// Joint coordinates are integrated to second order, so momentum, which is no coordinate, would drift. Of a free tree
/// it is known: what acts from outside alone changes it. So the free link gets the velocity and the spin that make it
/// right, joints keep theirs, and the centre of mass moves by the trapezoidal rule: a parabola.
/// Units: the tree's, see PreparedLink; angular momentum about the centre of mass, along the world's axes.
template <class S> class FreeMotion {
 public:
  /// Begins a step, after the dynamics' place, spin and follow.
  void begin(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links, const ArticulationState<S>& state);
  /// Adds what acts within a sub-step, at its middle.
  void push(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links);
  /// Sets the free link's motion at the end of a sub-step, after place, spin and follow.
  void finish(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links, ArticulationState<S>& state);

 private:
  /// The motion of the whole tree against the anchor of the free link and its velocity.
  struct Measured {
    Vec3<S> centre, velocity, angular;
  };
  static Vec3<S> centre_of(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links);
  static Measured measured(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links);
  static Mat3<S> inertia(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links, Vec3<S> centre);

  Vec3<S> velocity_, angular_;  // of the whole tree
  Vec3<S> centre_;              // against the free link's anchor, where the last sub-step ended
  Vec3<S> way_;                 // of the centre within the sub-step
};

}  // namespace isostep::detail
