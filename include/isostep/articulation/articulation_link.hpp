// One link of an articulation: the joint it hangs on, its mass, and what drives it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// The type of the joint between a link and its parent. The place is the number in files.
///   fixed   not at all
///   hinge   turns about `axis`                              1 coordinate [rad]
///   slider  moves along `axis`                              1 coordinate [m]
///   ball    turns any way, by a cone of `upper` at most     a quaternion
///   free    moves any way: only the first link, from the base
enum class ArticulationJoint : std::uint32_t { fixed, hinge, slider, ball, free };
inline constexpr std::uint32_t kArticulationJoints = 5;

/// The parent of what hangs on the base.
inline constexpr std::uint32_t kArticulationBase = 0xffffffffu;

/// A link's mass, about its centre. Inertia 0 is a point's; of what turns any way it counts as that of a small ball.
template <class S> struct LinkMass {
  S mass = S(1);                                        // [kg] above 0
  Vec3<S> centre = {S(0), S(0), S(0)};                  // [m] in the link's frame
  Vec3<S> inertia = {S(0), S(0), S(0)};                 // [kg m^2] about the centre, along the principal axes
  Quat<Unit<S>> principal = Quat<Unit<S>>::identity();  // from the principal axes to the link's frame

  /// The mass of shapes, by mass_properties().
  static ISO_INLINE constexpr LinkMass of(const MassProperties<S>& p) {
    return {p.mass,
            p.centre,
            {detail::kappa_of_axis(p.mass, p.kappa.x), detail::kappa_of_axis(p.mass, p.kappa.y),
             detail::kappa_of_axis(p.mass, p.kappa.z)},
            p.principal};
  }
  ISO_FIELDS(mass, centre, inertia, principal)
};

/// A servo, a motor, or both: stiffness (target - position) + damping (speed - velocity), of max_force at most.
/// Of a ball in all three directions; `target` and speed.x are a hinge's and slider's, `pose` and `speed` a ball's.
template <class S> struct ArticulationDrive {
  S target = S(0);                                 // [rad], [m]
  Quat<Unit<S>> pose = Quat<Unit<S>>::identity();  // [1] frame b in frame a
  Vec3<S> speed = {S(0), S(0), S(0)};              // [rad/s], [m/s]; a ball's along the axes of frame a
  S stiffness = S(0);                              // [N m/rad], [N/m]
  S damping = S(0);                                // [N m s/rad], [N s/m]; however large, it is implicit
  S max_force = S(0);                              // [N m], [N] 0: no drive

  ISO_FIELDS(target, pose, speed, stiffness, damping, max_force)
};

/// Frame a, in the parent, and frame b, in the link, are one at coordinate 0.
template <class S> struct ArticulationLink {
  std::uint32_t parent = kArticulationBase;  // an earlier link
  ArticulationJoint type = ArticulationJoint::hinge;
  Pose<S> frame_a = Pose<S>::identity();                      // [m] in the parent's frame, or the base's
  Pose<S> frame_b = Pose<S>::identity();                      // [m] in the link's frame
  Vec3<Unit<S>> axis = {Unit<S>(0), Unit<S>(0), Unit<S>(1)};  // [1] in both; of a ball the axis of its cone
  LinkMass<S> mass = {};
  S armature = S(0);   // [kg m^2], [kg] of a geared rotor: resists the joint alone
  S damping = S(0);    // [N m s/rad], [N s/m]
  S stiffness = S(0);  // [N m/rad], [N/m] of a spring
  S rest = S(0);       // [rad], [m] where it is slack; of a ball at coordinate 0
  bool limited = false;
  S lower = S(0), upper = S(0);     // [rad], [m]; of a ball `upper` alone, 0.05 to 2.8: the cone's half angle
  ArticulationDrive<S> drive = {};  // at first; see Articulation::set_drive

  ISO_FIELDS(parent, type, frame_a, frame_b, axis, mass, armature, damping, stiffness, rest, limited, lower, upper,
             drive)
};

/// The position and velocity of a joint. What its type has not is 0, and the identity.
template <class S> struct JointCoordinates {
  Vec3<S> position = {S(0), S(0), S(0)};               // x: [rad] hinge, [m] slider; free: [m] along frame a
  Quat<Unit<S>> rotation = Quat<Unit<S>>::identity();  // ball, free: frame b in frame a
  Vec3<S> velocity = {S(0), S(0), S(0)};               // x: [rad/s] hinge, [m/s] slider; free: [m/s]
  Vec3<S> angular_velocity = {S(0), S(0), S(0)};       // [rad/s] ball, free: along the axes of frame a
};

}  // namespace isostep
