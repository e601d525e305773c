// Vehicle and Wheel: wheels on springs that roll, grip, drive, brake and steer.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using VehicleId = Id<struct VehicleTag>;
using WheelId = Id<struct WheelTag>;

inline constexpr std::uint32_t kMostGears = 8;
/// [rad/s] The fastest engine: geared by the largest ratio to a body that turns as fast as it may. 8192 in Q16.16.
template <class S> ISO_INLINE constexpr S fastest_engine() {
  return Limits<S>::mass_ratio() * Limits<S>::angular_speed();
}

/// Engine, brakes and steering of all wheels of a body; one record a body. Wheels need none: a cart's only roll.
///   engine        throttle * engine_torque, as long as its shaft, which the wheels turn at gear * final_drive times
///                 their mean speed, is slower than engine_speed that way. Negative throttle drives backwards.
///   clutch        where engine_inertia is not 0 the engine turns by itself, at engine_spin, and its torque acts on it.
///                 The clutch is friction between it and the shaft that the wheels turn: it ends the difference of
///                 their speeds with a torque of at most clutch * clutch_torque, which the engine loses and the shaft
///                 gets. In neutral it passes on nothing. Nothing else slows the engine down, and it runs while the
///                 body is awake and has wheels. 0: its shaft is that of the wheels, without inertia.
///   differential  torque * gear * final_drive, of which no more than Limits::mass_ratio() counts, divided by the
///                 wheels' drive_share. What differential_lock says is the part of the difference in speed between
///                 driven wheels that it takes in each iteration: 0: open, 1: locked.
///   brakes        at each wheel brake * brake_torque * its brake_share and the same of the handbrake, against its spin
///   steering      each wheel turns by steer * its steer_angle, counter-clockwise seen from above where positive. Of
///                 that ackermann 1 makes the angle of a wheel in the middle between left and right: all axles point to
///                 one centre, on the line through the wheels that are not steered. 0: each by the same angle.
///   tracks        the drive of each track on the side to which steer turns, left where positive, is geared by
///                 1 - track_steer * |steer|: its share of the torque is that times as much, a turn of it counts that
///                 much for the shaft, and a differential that is locked holds its speed to that part of the others'.
///                 0: it rolls freely; -1, as track_steer 2 has it at full steer: it runs backwards, and the body
///                 turns on the spot. Throttle or a locked differential turns the body, steer alone does not. A
///                 track's side is that of its wheel with the lowest slot, against the body's centre of mass.
/// Inputs stand in VehicleInput; setting them wakes the body.
template <class S> struct VehicleSettings {
  BodyId body = {};
  S engine_torque = S(0);                                                  // [N m] at full throttle
  S engine_speed = S(600);                                                 // [rad/s] at which it has no torque left
  S gears[kMostGears] = {S(1), S(0), S(0), S(0), S(0), S(0), S(0), S(0)};  // [1] 0: neutral; below 0: reverse
  S final_drive = S(1);                                                    // [1]
  S engine_inertia = S(0);                                                 // [kg m^2] 0, or 2^-10 or more
  S clutch_torque = S(0);                                                  // [N m] at most, fully engaged
  S differential_lock = S(0);                                              // [1] 0 to 1
  S brake_torque = S(0);                                                   // [N m] a wheel
  S handbrake_torque = S(0);                                               // [N m] a wheel
  S ackermann = S(1);                                                      // [1] 0 to 1
  S track_steer = S(2);                                                    // [1] 0 to 2

  ISO_FIELDS(body, engine_torque, engine_speed, gears, final_drive, engine_inertia, clutch_torque, differential_lock,
             brake_torque, handbrake_torque, ackermann, track_steer)
};

/// The input of a vehicle. It lasts until the game sets another.
template <class S> struct VehicleInput {
  S throttle = S(0);       // [1] -1 to 1
  S clutch = S(1);         // [1] 0: the engine runs alone, to 1: engaged
  S brake = S(0);          // [1] 0 to 1
  S handbrake = S(0);      // [1] 0 to 1
  S steer = S(0);          // [1] -1 to 1
  std::uint32_t gear = 0;  // of VehicleSettings::gears

  ISO_FIELDS(throttle, clutch, brake, handbrake, steer, gear)
};

/// The state of a vehicle with a clutch, which the step writes.
template <class S> struct VehicleState {
  S engine_spin = S(0);  // [rad/s] of its shaft, up to fastest_engine()
  S clutch_load = S(0);  // [N m] on the gears, in the last sub-step

  ISO_FIELDS(engine_spin, clutch_load)
};

/// A wheel that slides along `suspension` from its hard point, without mass of its own but for its turning. Forward is
/// axle x up, where up is against `suspension`; a positive spin rolls forward.
///   ground      a sphere of the wheel's radius is cast along the suspension, or a ray where it meets nothing level
///               enough: each step, and each sub-step on what is no plane as far as it gets; that moves with its body
///   suspension  stiffness (free_length - length) - damping d(length)/dt, by backward Euler, never below 0: it pushes.
///               Shorter than free_length - travel it does not get. Wheels of a body with the same `axle` other than 0
///               are joined by a bar, which adds anti_roll times the difference of their lengths.
///   tyre        along and across the wheel a force that ends the slip, at most that of the ellipse with the radii
///               mu load: mu is the root of grip times the ground's friction. What stands sticks
///   slip        the speed with which the tyre slides by that of its middle over the ground, or by 1 m/s if that is
///               slower. Of that mu is a table: itself at 0, peak_grip times that at peak_slip, slide_grip times that
///               from slide_slip on, lines between. As it is made, it does not depend on slip
///   track       wheels of a body with the same `track` other than 0 roll as fast as one another, spin times radius, as
///               in a chain without mass: torques, brakes and tyres of each turn all of them
/// The ground bears the opposite of each force. All are solved in every sub-step, together for all wheels of a body.
template <class S> struct WheelSettings {
  BodyId body = {};
  Vec3<S> hard_point = {S(0), S(0), S(0)};                           // [m] body frame: the wheel's middle at length 0
  Vec3<Unit<S>> suspension = {Unit<S>(0), Unit<S>(-1), Unit<S>(0)};  // [1] body frame, unit length: down
  Vec3<Unit<S>> axle_direction = {Unit<S>(1), Unit<S>(0), Unit<S>(0)};  // [1] body frame, unit length: to the left
  S free_length = S(0.3);                                               // [m]
  S travel = S(0.3);                                                    // [m]
  S stiffness = S(0);                                                   // [N/m]
  S damping = S(0);                                                     // [N s/m]
  S radius = S(0.35);                                                   // [m]
  S inertia = S(1);                                                     // [kg m^2] about the axle
  S grip_along = S(1);                                                  // [1] friction
  S grip_across = S(1);                                                 // [1]
  S peak_slip = S(0.0625);                                              // [1] above 0
  S peak_grip = S(1);                                                   // [1]
  S slide_slip = S(0.25);                                               // [1] above peak_slip
  S slide_grip = S(1);                                                  // [1]
  S steer_angle = S(0);                                                 // [rad] at steer 1
  S drive_share = S(0);      // [1] of the torque, to those of the other wheels
  S brake_share = S(1);      // [1]
  S handbrake_share = S(0);  // [1]
  std::uint32_t axle = 0;    // of the anti-roll bar
  S anti_roll = S(0);        // [N/m] the larger of the two counts
  std::uint32_t track = 0;   // 0: none

  ISO_FIELDS(body, hard_point, suspension, axle_direction, free_length, travel, stiffness, damping, radius, inertia,
             grip_along, grip_across, peak_slip, peak_grip, slide_slip, slide_grip, steer_angle, drive_share,
             brake_share, handbrake_share, axle, anti_roll, track)
};

/// The state of a wheel, which the step writes. Without ground contact_body is null, and load, along and across are 0.
template <class S> struct WheelState {
  S spin = S(0);     // [rad/s] about the axle, seen from the body
  S angle = S(0);    // [rad] that it has turned, 0 to 2 pi
  S steered = S(0);  // [rad] from axle_direction, counter-clockwise seen from above
  S length = S(0);   // [m] from the hard point to the wheel's middle
  S slip = S(0);     // [1] of the tyre: the mean of this and earlier sub-steps, the last counts a half
  BodyId contact_body = {};
  Vec3<S> contact_point = {S(0), S(0), S(0)};                           // [m] world
  Vec3<Unit<S>> contact_normal = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};  // [1] of the ground, world
  S load = S(0);                                                        // [N] along the normal
  S along = S(0);                                                       // [N] on the body, forward
  S across = S(0);                                                      // [N] on the body, normal x forward

  ISO_FIELDS(spin, angle, steered, length, slip, contact_body, contact_point, contact_normal, load, along, across)
};

}  // namespace isostep

namespace isostep::detail {

/// [1] m r^2 / I: the ratio of the speed changes that an impulse at the rim gives the rim and the body.
template <class S> ISO_INLINE S rim_give(S mass, S radius, S inertia) {
  return saturate_to<S>(product(radius, saturate_to<S>(product(mass, divide_to<S>(radius, inertia)))));
}

template <class S> struct RecordRules<VehicleSettings<S>> : RecordDefaults<S> {
  static constexpr bool kSeesOthers = true;
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const VehicleSettings<S>& v) {
    NumberChecks<S> checks;
    checks.not_negative(v.engine_torque, "engine_torque");
    checks.not_negative(v.engine_speed, "engine_speed");
    for (const S gear : v.gears) checks.list.finite(gear, "gears");
    checks.list.finite(v.final_drive, "final_drive");
    checks.list.finite(v.engine_inertia, "engine_inertia")
        .proper(v.engine_inertia == S(0) || S(0x1p-10) <= v.engine_inertia, "engine_inertia", "0, or 2^-10 or more");
    checks.not_negative(v.clutch_torque, "clutch_torque");
    checks.part(v.differential_lock, "differential_lock");
    checks.not_negative(v.brake_torque, "brake_torque");
    checks.not_negative(v.handbrake_torque, "handbrake_torque");
    checks.part(v.ackermann, "ackermann");
    checks.list.finite(v.track_steer, "track_steer")
        .proper(S(0) <= v.track_steer && v.track_steer <= S(2), "track_steer", "0 to 2");
    return checks.list.report();
  }
  static FaultReport fault(const VehicleInput<S>& v) {
    NumberChecks<S> checks;
    checks.input(v.throttle, "throttle");
    checks.part(v.clutch, "clutch");
    checks.part(v.brake, "brake");
    checks.part(v.handbrake, "handbrake");
    checks.input(v.steer, "steer");
    checks.list.proper(v.gear < kMostGears, "gear", "0 to 7");
    return checks.list.report();
  }
  static FaultReport fault(const VehicleState<S>& v) {
    return Checklist()
        .finite(v.engine_spin, "engine_spin")
        .in_range(within(v.engine_spin, fastest_engine<S>()), "engine_spin", "a size up to fastest_engine()")
        .finite(v.clutch_load, "clutch_load")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const VehicleSettings<S>& v) { return named_body<S>(v.body, MustBe::dynamic); }
  static constexpr OnlyOne only_one(const VehicleSettings<S>&) { return kOneABody; }
  static RecordKey key(const VehicleSettings<S>& r) { return {r.body.slot}; }
  template <class Random> static void draw(VehicleInput<S>& v, Random& random) {
    v.throttle = random.in(-1, 1);
    if (random.one_in(3)) v.brake = random.in(0, 1);
    if (random.one_in(6)) v.handbrake = random.in(0, 1);
    v.steer = random.in(-1, 1);
    v.gear = random.below(3);
    if (random.one_in(2)) v.clutch = random.in(0, 1);
  }
};

template <class S> struct RecordRules<WheelSettings<S>> : RecordDefaults<S> {
  static constexpr bool kSeesOthers = true;
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const WheelSettings<S>& w) {
    constexpr S kMostSteer = S(1.570796326794896619);  // [rad]
    NumberChecks<S> checks;
    checks.list.also(fault_of_place(w.hard_point, "hard_point"));
    checks.direction(w.suspension, "suspension");
    checks.direction(w.axle_direction, "axle_direction");
    checks.list.proper(within(dot(w.axle_direction, w.suspension), Unit<S>(0.5)), "axle_direction",
                       "one across the suspension, to 30 degrees");
    checks.size(w.free_length, "free_length");
    checks.not_negative(w.travel, "travel");
    checks.list.proper(w.travel <= w.free_length, "travel", "0 to free_length");
    checks.not_negative(w.stiffness, "stiffness");
    checks.not_negative(w.damping, "damping");
    checks.size(w.radius, "radius");
    checks.list.finite(w.inertia, "inertia").proper(S(0) < w.inertia, "inertia", "above 0");
    checks.grip(w.grip_along, "grip_along");
    checks.grip(w.grip_across, "grip_across");
    checks.size_of_slip(w.peak_slip, "peak_slip");
    checks.grip(w.peak_grip, "peak_grip");
    checks.size_of_slip(w.slide_slip, "slide_slip");
    checks.list.proper(w.peak_slip < w.slide_slip, "slide_slip", "above peak_slip");
    checks.grip(w.slide_grip, "slide_grip");
    checks.list.finite(w.steer_angle, "steer_angle")
        .in_range(within(w.steer_angle, kMostSteer), "steer_angle", "-pi/2 to pi/2");
    checks.part(w.drive_share, "drive_share");
    checks.part(w.brake_share, "brake_share");
    checks.part(w.handbrake_share, "handbrake_share");
    checks.not_negative(w.anti_roll, "anti_roll");
    return checks.list.report();
  }
  static FaultReport fault(const WheelState<S>& w) {
    NumberChecks<S> checks;
    checks.list.finite(w.spin, "spin").finite(w.angle, "angle").finite(w.length, "length");
    checks.list.finite(w.steered, "steered");
    checks.list.finite(w.slip, "slip").proper(S(0) <= w.slip && w.slip <= S(4), "slip", "0 to 4");
    checks.list.finite(w.contact_point, "contact_point").finite(w.contact_normal, "contact_normal");
    checks.list.in_range(within(w.angle, kMaxAngle<S>), "angle", "-2 pi to 2 pi");
    checks.list.in_range(within(w.steered, kMaxAngle<S>), "steered", "-2 pi to 2 pi");
    checks.not_negative(w.load, "load");
    checks.list.finite(w.along, "along").finite(w.across, "across");
    return checks.list.report();
  }
  static constexpr NamedBodies<S> bodies(const WheelSettings<S>& w) {
    return named_point(w.body, w.hard_point, "hard_point");
  }
  /// Checks that tyre and body are within the range of masses that one row bears.
  static FaultReport fault_at(const WheelSettings<S>& w, const RecordPlace<S>& place) {
    return Checklist()
        .in_range(rim_give(place.bodies[0]->mass, w.radius, w.inertia) <= Limits<S>::leverage(), "inertia",
                  "mass radius^2 / inertia up to Limits::leverage()")
        .report();
  }
};

}  // namespace isostep::detail
