// A character: a kinematic body that walks, climbs steps, falls and jumps, and pushes with a force, not with its mass.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using CharacterId = Id<struct CharacterTag>;

enum class Footing : std::uint32_t {
  airborne,
  floor,  // it walks: on one plane, or between several steep ones that hold it together
  steep   // it touches ground that it cannot stand on
};

/// Moves a kinematic body of one convex part at the end of every step, upright as the game has turned it: with the
/// ground, then along CharacterInput::move or by gravity, around obstacles. Other bodies are where the step left them.
/// Towards another character it goes half of the way. It pushes dynamic obstacles in the next step with at most
/// push_force, up to the speed that is asked for, and puts its weight on dynamic ground.
/// Source:  Quake's moves by casts and planes; steps by up, forward, down as in Source and Jolt's CharacterVirtual.
template <class S> struct CharacterSettings {
  BodyId body = {};
  S step_height = S(0.375);          // [m] that it climbs, and follows down
  S least_up = S(0.7071067811);      // [1] of a normal that it stands on: the cosine of the steepest slope
  S skin = S(0.015625);              // [m] that it keeps from what is in its way
  S mass = S(80);                    // [kg] that its ground bears
  S push_force = S(500);             // [N]
  S air_acceleration = S(10);        // [m/s^2] towards CharacterInput::move while it is in the air
  S gravity_scale = S(1);            // [1]
  std::uint32_t mask = 0xffffffffu;  // categories in its way, of those that its body's Filter collides with

  ISO_FIELDS(body, step_height, least_up, skin, mass, push_force, air_acceleration, gravity_scale, mask)
};

/// The input of a character. It lasts until the game sets another.
template <class S> struct CharacterInput {
  Vec3<S> move = {S(0), S(0), S(0)};  // [m/s] along the ground, world
  S jump = S(0);                      // [m/s] upwards; 0 again once it has left the ground

  ISO_FIELDS(move, jump)
};

/// The state of a character, which the step writes.
template <class S> struct CharacterState {
  Footing footing = Footing::airborne;
  BodyId ground = {};                     // null: airborne, or put elsewhere since
  std::uint32_t stuck = 0;                // [steps] in a row in which it could not leave what it overlaps
  Vec3<S> foot = {S(0), S(0), S(0)};      // [m] on the ground, in its body's frame
  Vec3<S> foot_at = {S(0), S(0), S(0)};   // [m] the same, world
  Vec3<S> velocity = {S(0), S(0), S(0)};  // [m/s] world
  Vec3<Unit<S>> normal = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};  // [1] of the ground

  ISO_FIELDS(footing, ground, stuck, foot, foot_at, velocity, normal)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<CharacterSettings<S>> : RecordDefaults<S> {
  static constexpr bool kSeesOthers = true;
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const CharacterSettings<S>& c) {
    const S least = Limits<S>::minimum_size() * S(0.0625);
    return Checklist()
        .finite(c.step_height, "step_height")
        .finite(c.least_up, "least_up")
        .finite(c.skin, "skin")
        .finite(c.mass, "mass")
        .finite(c.push_force, "push_force")
        .finite(c.air_acceleration, "air_acceleration")
        .finite(c.gravity_scale, "gravity_scale")
        .in_range(c.step_height <= Limits<S>::extent(), "step_height", "0 to Limits::extent()")
        .in_range(c.mass <= Limits<S>::mass(), "mass", "0 to Limits::mass()")
        .in_range(c.air_acceleration <= Limits<S>::speed(), "air_acceleration", "0 to Limits::speed()")
        .in_range(within(c.gravity_scale, S(16)), "gravity_scale", "a size up to 16")
        .proper(S(0) <= c.step_height, "step_height", "0 to Limits::extent()")
        .proper(S(0) < c.least_up && c.least_up <= S(1), "least_up", "above 0, up to 1")
        .proper(least <= c.skin && c.skin <= S(0.25), "skin", "Limits::minimum_size() / 16 to 0.25")
        .proper(S(0) <= c.mass, "mass", "0 to Limits::mass()")
        .proper(S(0) <= c.push_force, "push_force", kZeroOrMore)
        .proper(S(0) <= c.air_acceleration, "air_acceleration", "0 to Limits::speed()")
        .report();
  }
  static FaultReport fault(const CharacterInput<S>& c) {
    const S speed = Limits<S>::speed() * S(0.5);
    return Checklist()
        .finite(c.move, "move")
        .finite(c.jump, "jump")
        .in_range(no_longer(c.move, speed), "move", "up to half of Limits::speed()")
        .in_range(c.jump <= speed, "jump", "0 to half of Limits::speed()")
        .proper(S(0) <= c.jump, "jump", "0 to half of Limits::speed()")
        .report();
  }
  static FaultReport fault(const CharacterState<S>& c) {
    return Checklist()
        .finite(c.velocity, "velocity")
        .also(fault_of_place(c.foot, "foot"))
        .also(fault_of_place(c.foot_at, "foot_at"))
        .in_range(within(c.velocity, Limits<S>::speed()), "velocity", "components up to Limits::speed()")
        .proper(c.footing <= Footing::steep, "footing", "one of Footing")
        .proper(c.normal == Vec3<Unit<S>>::zero() || is_direction<S>(c.normal), "normal", "a vector of length 1, or 0")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const CharacterSettings<S>& c) {
    return named_body<S>(c.body, MustBe::kinematic);
  }
  static constexpr OnlyOne only_one(const CharacterSettings<S>&) { return kOneABody; }
  static RecordKey key(const CharacterSettings<S>& r) { return {r.body.slot}; }
  /// Accepts only bodies that can be cast: one convex part with an end.
  static FaultReport fault_at(const CharacterSettings<S>&, const RecordPlace<S>& place) {
    const bool one = place.parts.size() == 1;
    const bool walks = one && !is_surface(place.parts[0].primitive.type) && is_bounded(place.parts[0].primitive.type);
    return Checklist().ask(walks, Fault::bad_shape, "body", "one of a single convex part with an end").report();
  }
  template <class Random> static void draw(CharacterSettings<S>& c, Random& random) {
    c.body = random.kinematic_body();
    c.push_force = random.in(0, 200);
    c.mass = random.in(0, 20);
  }
  template <class Random> static void draw(CharacterInput<S>& c, Random& random) {
    c.move = random.arrow(0, 4);
    if (random.one_in(3)) c.jump = random.in(1, 4);
  }
};

}  // namespace isostep::detail
