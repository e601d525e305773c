// One joint of an articulation within a sub-step: springs, dampers, drives and limits, linear in its answer.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/articulation/articulated_tree.hpp"
#include "isostep/articulation/articulation_limits.hpp"
#include "isostep/articulation/articulation_state.hpp"
#include "isostep/articulation/spatial.hpp"

namespace isostep::detail {

/// The bound that holds a joint, and the limit of its drive.
enum class Stop : std::uint8_t { none, lower, upper };
enum class Drive : std::uint8_t { none, within, most };

/// Vectors have their x alone for a hinge or slider, in [rad] or the tree's units of length; for a ball they are along
/// the axes of frame a. Forces are over the tree's mass.
///
/// A sub-step moves the joint half its way with the speed v it has (to q), changes v by h a, and moves it the other
/// half with the new speed. What depends on q and v is taken where the step leads to: for weak springs half-way, so
/// that they keep their energy, for stiff ones at the end, so that they come to rest:
///   q + s h v + (1/4 + 3/4 s) h^2 a,   v + (1/2 + 1/2 s) h a,   s = r^2 / (1 + r^2),
///   r = (h d / 2 + h^2 k / 4) / D: above 1 no step of the midpoint rule could follow the spring.
/// For every s in [0, 1] the step is stable at any stiffness k and damping d, and an undamped spring gains no energy:
/// the determinant of its linear map is 1 - s h^2 k / (D + (1/4 + 3/4 s) h^2 k).
///
/// A limit lets the speed after the sub-step lead to it, not beyond: halves of two sub-steps make one whole way from q,
/// so it is never passed. What is stopped has its acceleration prescribed. As one would not pass a limit with speed 0,
/// the speeds are the nearest, measured by kinetic energy, in a convex set that holds 0: energy is only lost.
template <class S> struct JointWork {
  Vec3<S> position, velocity;  // q, v; of a ball 2 vec(q)
  Vec3<S> answer;              // a, once known
  // The drive.
  Vec3<S> miss, speed;         // target - position; what it shall do
  S stiffness, damping, most;  // h^2 k, h d, and the largest force
  Vec3<Unit<S>> most_way;      // [1] the way of it, where it is at its most
  // Linear in the answer: force - pivot * answer.
  S blend;  // s
  S pivot;
  Vec3<S> force;
  // The limit.
  Vec3<Unit<S>> cone;         // [1] of a ball, the axis that leads out of its cone
  S room_up, room_down;       // to the limits
  S stop_speed, stop_answer;  // prescribed
  S stop_force;               // of the stop, upwards
  Stop stop;
  Drive drive;

  /// Prepares a step: the drive's coefficients.
  void prepare(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, const ArticulationDrive<S>& drive_of_it);
  /// Begins a sub-step: measures the joint's position and velocity, releases all stops.
  void begin(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, const ArticulationState<S>& state,
             const ArticulationDrive<S>& drive_of_it);
  /// Linearises the joint under inertia D of the tree at it, armature included.
  void linearise(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, S inertia);
  /// Chooses stop and drive by `answer`. Returns true if they changed. Unless `may_release`, what holds stays held.
  bool choose(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, bool may_release);
  /// Returns the speed nearest to `v` that the limits allow; for a cone, along its axis.
  S allowed(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, S v) const;

 private:
  void measure_ball(const PreparedLink<S>& l, Quat<Unit<S>> rotation, const ArticulationDrive<S>& drive_of_it);
  Vec3<S> spring(const ArticulatedTree<S>& tree, Vec3<S> way, S stiffness_of_it, Vec3<S> speed_of_it,
                 S damping_of_it) const;
  S most_speed(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, S room) const;
  bool choose_stop(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, bool may_release);
  bool choose_drive(const ArticulatedTree<S>& tree, bool may_release);
  void stop_at(const ArticulatedTree<S>& tree, Stop which, S speed, S now);
};

}  // namespace isostep::detail
