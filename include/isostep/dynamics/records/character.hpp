// Character: a kinematic body that walks, climbs steps, falls and jumps, and pushes with a force, not with its mass.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using CharacterId = Id<struct CharacterTag>;

enum class Footing : std::uint32_t {
  airborne,
  floor,  // it walks: on one plane, or between several steep ones that hold it together
  steep   // it touches ground that it cannot stand on
};

/// Moves a kinematic body of one convex part, upright as the game has turned it, at the end of every step: carried by
/// the ground, then along `move` or by gravity, around what is in its way. Other bodies are where the step left them;
/// to another character it goes half of the way. What is dynamic in its way is pushed in the next step by at most
/// push_force, until it moves as fast as is asked for, and dynamic ground bears its weight.
/// The game sets `move` and `jump` every frame, and reads the rest.
/// Source:  Quake's moves by casts and planes; steps by up, forward, down as in Source and Jolt's CharacterVirtual.
template <class S> struct Character {
  BodyId body = {};
  S step_height = S(0.375);               // [m] that it climbs, and follows down
  S least_up = S(0.7071067811);           // [1] of a normal that it stands on: the cosine of the steepest slope
  S skin = S(0.015625);                   // [m] that it keeps from what is in its way
  S mass = S(80);                         // [kg] that its ground bears
  S push_force = S(500);                  // [N]
  S air_acceleration = S(10);             // [m/s^2] towards `move` while it is in the air
  S gravity_scale = S(1);                 // [1]
  std::uint32_t mask = 0xffffffffu;       // categories in its way, of those that its body's Filter collides with
  Vec3<S> move = {S(0), S(0), S(0)};      // [m/s] along the ground, world
  S jump = S(0);                          // [m/s] upwards; 0 again once it has left the ground
  Footing footing = Footing::airborne;    // from here on: how the last step left it
  BodyId ground = {};                     // null: airborne, or put elsewhere since
  Vec3<S> foot = {S(0), S(0), S(0)};      // [m] on the ground, in its body's frame
  Vec3<S> foot_at = {S(0), S(0), S(0)};   // [m] the same, world
  Vec3<S> velocity = {S(0), S(0), S(0)};  // [m/s] world
  Vec3<Unit<S>> normal = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};  // [1] of the ground
  std::uint32_t stuck = 0;  // [steps] in a row in which it could not leave what it overlaps

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("step_height", self.step_height);
    visit("least_up", self.least_up);
    visit("skin", self.skin);
    visit("mass", self.mass);
    visit("push_force", self.push_force);
    visit("air_acceleration", self.air_acceleration);
    visit("gravity_scale", self.gravity_scale);
    visit("mask", self.mask);
    visit("move", self.move);
    visit("jump", self.jump);
    visit("footing", self.footing);
    visit("ground", self.ground);
    visit("foot", self.foot);
    visit("foot_at", self.foot_at);
    visit("velocity", self.velocity);
    visit("normal", self.normal);
    visit("stuck", self.stuck);
  }
};

}  // namespace isostep
