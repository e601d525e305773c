// Definitions: what a user says to make a body.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/body.hpp"

namespace isostep {

/// The mass of a dynamic body, and its principal moments of inertia.
template <class S> struct BodyMass {
  S density = S(1);                      // [kg/m^3] where mass is 0; water has 1000
  S mass = S(0);                         // [kg] 0: from density
  Vec3<S> inertia = {S(0), S(0), S(0)};  // [kg m^2] principal, body axes; all 0: from the shape

  ISO_FIELDS(density, mass, inertia)
};

template <class S> struct BodyDefinition {
  BodyType type = BodyType::static_;
  ShapeId shape = {};
  Vec3<S> position = {S(0), S(0), S(0)};  // [m] of the body's origin, world
  Quat<Unit<S>> orientation = Quat<Unit<S>>::identity();
  Vec3<S> velocity = {S(0), S(0), S(0)};          // [m/s] of the centre of mass
  Vec3<S> angular_velocity = {S(0), S(0), S(0)};  // [rad/s] world
  S density = S(1);                               // [kg/m^3] where mass is 0; water has 1000
  S mass = S(0);                                  // [kg] 0: from density
  Vec3<S> inertia = {S(0), S(0), S(0)};           // [kg m^2] principal, body axes; all 0: from the shape
  Material<S> material = {};
  Filter filter = {};
  std::uint64_t user_data = 0;
  S gravity_scale = S(1);    // [1] of the world's gravity
  S linear_damping = S(0);   // [1/s]
  S angular_damping = S(0);  // [1/s]
  std::uint32_t locks = 0;   // body_flag::kLockX ...
  bool sensor = false;       // tells what it overlaps, and touches nothing
  bool allow_sleep = true;
  bool collide = true;  // false: no contacts, no events
  bool bullet = false;  // moving bodies stop it too, at any speed; two bullets may pass through each other
  bool report_contacts = false;  // events tell when contacts begin and end; parts may report by themselves

  ISO_FIELDS(type, shape, position, orientation, velocity, angular_velocity, density, mass, inertia, material, filter,
             user_data, gravity_scale, linear_damping, angular_damping, locks, sensor, allow_sleep, collide, bullet,
             report_contacts)
};

}  // namespace isostep
