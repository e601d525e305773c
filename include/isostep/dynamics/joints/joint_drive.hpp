// A drive: one coordinate of a joint on which a spring, a motor and limits act together, as one row of the joint.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/joints/joint_rows.hpp"
#include "isostep/dynamics/records/axis_drive.hpp"

namespace isostep {

/// Source:  the sum of an implicit spring, a motor with a largest force and two stops is a maximal monotone law between
///          speed and impulse (Brogliato 2016, Nonsmooth Mechanics, ch. 5): at every speed at most one part of it is
///          vertical. So one row is enough, and which piece of the law it is on decides the row: a fixed speed, a
///          spring, or a constant impulse. A servo is a spring of bounded force: beyond it its pieces are a motor's.
/// Symbols: v = speed along the row, lambda = impulse as velocity change of the reduced mass. Spring: lambda = -w (w v
///          + push), w^2 = (h c + h^2 k) / effective mass. Motor: lambda in [-most, most]. A spring's row is scaled by
///          w / sqrt(1 + w^2): its pivot stays near one however weak it is.
template <class S> struct JointDrive {
  const AxisDrive<S>* asked;         // null: the joint's properties ask
  const AxisDrive<S>* spring_asked;  // whose spring acts: in a cone of either swing
  JointRow<S> row;
  std::uint32_t block, place;  // which of the joint's rows it is
  S radius;                    // [m] of an angle
  S position;                  // [m] an angle times the radius, or a length
  S lower, upper, target;      // [m]
  bool bounded_below, bounded_above, sprung, driven;
  bool servo;                  // sprung, not driven: the spring gives no more than most_impulse()
  bool soft, yields;           // its limits are soft; it is beyond one, and the limit's spring acts
  bool sways;                  // stands across a rod, rope or spring, as a damper: joint_sway.hpp
  S frequency, damping;        // [Hz], [1] of the spring
  S spring_inverse;            // [1] reduced mass / mass that the spring is made for, in the row's unit
  S half_tangent;              // [1] of a swing's limit: tan(upper / 2)
  S sway, sway_left;           // [s/m] of one that sways: h / length; [1] what explicit steps can follow
  S force, most;               // [m/s^2] most impulse a second of the motor or servo, [m/s] and in a sub-step
  Velocity<S> push_speed;      // [m/s] with which it returns from beyond a limit
  Velocity<S> speed;           // [m/s] of the motor
  S spring_root, spring_rate;  // [1] w of an effective mass of one; [1/s] speed asked for per metre
  S spring;                    // [1] w; 0: no spring, or one too weak for the format to feel
  Direction<S> spring_row;     // [1] x = 1 / sqrt(1 + w^2), y = w / sqrt(1 + w^2)
  S spring_lag;                // [1] part of the last sub-step's way that the spring does not feel
  Velocity<S> spring_came;     // [m] that part
  Velocity<S> spring_speed;    // [m/s] that the spring asks for where it was
  Velocity<S> spring_push;     // [m/s] w times that
  Velocity<S> impulse;         // [m/s] accumulated, of all that acts along the row
  DrivePiece piece, next;
};

/// The range of speeds that the limits leave to a drive in a pass.
template <class S> struct DriveBounds {
  Velocity<S> low, high;  // [m/s]

  /// Returns the value for no bound: faster than anything moves, and sums with it fit.
  static ISO_INLINE constexpr Velocity<S> limitless() { return highest<Velocity<S>>() * Velocity<S>(0.5); }
};

namespace detail {

/// [m] Returns the way of a drive from its spring's target.
template <class S> ISO_INLINE Velocity<S> spring_way(const JointDrive<S>& drive) {
  return saturate_to<Velocity<S>>(product(drive.position - drive.target, Velocity<S>(1)));
}

/// [m/s] The most by which a free drive passes a bound without being stopped: the rounding of a fixed speed.
template <class S> inline constexpr Velocity<S> kPieceTolerance = Velocity<S>(0x1p-14);
/// [m/s] The most speed with which an angle returns from beyond its limit, at its lever: a limb of five centimetres at
/// five radians a second. pgs keeps as speed what closes an error, and gains no more than that.
template <class S> inline constexpr Velocity<S> kAnglePushSpeed = Velocity<S>(0.25);
/// [rad] in a sub-step: a spring of this frequency still keeps its energy, and sags by a sixteenth more than it should.
template <class S> inline constexpr S kSpringLag = S(0.25);
/// The most refactorisations of a pass in which drives change to any piece. An impact in a chain of stops takes two or
/// three. Beyond it drives only let go of speeds that they hold against their law, each at most once. What is left then
/// is a stop that acts a pass too late and adds no energy; one that pulls would add any amount.
inline constexpr int kMostPieceChanges = 4;

/// Returns the least speed away from a bound at `gap` >= 0: the drive may reach it within the sub-step, not pass it.
/// Beyond it the drive is pushed back, no faster than `push_speed`.
template <class S> ISO_INLINE Velocity<S> least_speed(S gap, Velocity<S> push_speed, S rate, Step<S> h, S bias_rate) {
  using V = Velocity<S>;
  if (gap > S(0)) {
    const S most = Limits<S>::speed() * h;  // farther away than anything moves in a sub-step
    return most < gap ? -DriveBounds<S>::limitless() : -scaled(rate, convert<V>(gap));
  }
  const S deep = max(gap, -S(32) * h);
  return min(-scaled(bias_rate, convert<V>(deep)), push_speed);
}

template <class S> ISO_INLINE DriveBounds<S> bounds_of(const JointDrive<S>& drive, S rate, Step<S> h, S bias_rate) {
  using V = Velocity<S>;
  DriveBounds<S> bounds = {-DriveBounds<S>::limitless(), DriveBounds<S>::limitless()};
  if (drive.bounded_below) bounds.low = least_speed(drive.position - drive.lower, drive.push_speed, rate, h, bias_rate);
  if (drive.bounded_above) {
    bounds.high = -least_speed(drive.upper - drive.position, drive.push_speed, rate, h, bias_rate);
  }
  // Limits that are both passed, or nearer to each other than rounding: the middle.
  if (bounds.high < bounds.low) bounds.low = bounds.high = (bounds.low + bounds.high) * V(0.5);
  return bounds;
}

ISO_INLINE constexpr bool fixes_speed(DrivePiece piece) {
  return piece == DrivePiece::lower || piece == DrivePiece::upper || piece == DrivePiece::driven;
}
/// Returns true if the spring's force follows the speed on that piece. On others a stop or the bound of a servo does.
template <class S> ISO_INLINE bool springs(const JointDrive<S>& drive, DrivePiece piece) {
  return !fixes_speed(piece) && drive.spring > S(0) && !(drive.servo && piece != DrivePiece::free);
}
/// Returns true if the drive's impulse does not depend on its speed.
template <class S> ISO_INLINE bool is_constant(const JointDrive<S>& drive, DrivePiece piece) {
  return !fixes_speed(piece) && !springs(drive, piece);
}
/// Returns the motor's impulse on a piece of constant force.
template <class V> ISO_INLINE V motor_impulse(DrivePiece piece, V most) {
  return piece == DrivePiece::forwards ? most : piece == DrivePiece::backwards ? -most : V(0);
}
template <class S> ISO_INLINE Velocity<S> spring_impulse(const JointDrive<S>& drive, Velocity<S> speed) {
  const Velocity<S> damped = saturated<S>(product(drive.spring, speed));
  return -saturated<S>(product(drive.spring, damped + drive.spring_push));
}
template <class S>
ISO_INLINE Velocity<S> fixed_speed(const JointDrive<S>& drive, DrivePiece piece, const DriveBounds<S>& bounds) {
  return piece == DrivePiece::lower ? bounds.low : piece == DrivePiece::upper ? bounds.high : drive.speed;
}

/// Returns a piece that fits the present properties: a limit may be gone, a motor new.
template <class S> ISO_INLINE DrivePiece valid_piece(const JointDrive<S>& drive, DrivePiece piece) {
  const bool gone =
      (piece == DrivePiece::lower && !drive.bounded_below) || (piece == DrivePiece::upper && !drive.bounded_above) ||
      (piece == DrivePiece::driven && !drive.driven) || (piece > DrivePiece::driven && !drive.driven && !drive.servo);
  if (drive.driven) return gone || piece == DrivePiece::free ? DrivePiece::driven : piece;
  return gone ? DrivePiece::free : piece;
}

/// Returns the piece of a drive at a speed that no limit stops. `tie`: the piece if the motor wants just that speed.
template <class S>
ISO_INLINE DrivePiece piece_between_limits(const JointDrive<S>& drive, Velocity<S> speed, Velocity<S> most,
                                           DrivePiece tie) {
  if (drive.servo) {
    const Velocity<S> asked = spring_impulse(drive, speed);
    return most < asked ? DrivePiece::forwards : asked < -most ? DrivePiece::backwards : DrivePiece::free;
  }
  if (!drive.driven) return DrivePiece::free;
  return speed < drive.speed ? DrivePiece::forwards : drive.speed < speed ? DrivePiece::backwards : tie;
}

/// Returns the piece to try next, by the result of this one: its neighbour on the side where the law was left.
template <class S>
ISO_INLINE DrivePiece next_piece(const JointDrive<S>& drive, Velocity<S> speed, const DriveBounds<S>& bounds,
                                 Velocity<S> most) {
  using V = Velocity<S>;
  const V slack = kPieceTolerance<S>;
  const auto law = [&](DrivePiece piece, V v) ISO_INLINE_LAMBDA {
    return motor_impulse(piece, most) + (springs(drive, piece) ? spring_impulse(drive, v) : V(0));
  };
  switch (drive.piece) {
    case DrivePiece::lower: {
      const DrivePiece above = piece_between_limits(drive, bounds.low, most, DrivePiece::backwards);
      return drive.impulse < law(above, bounds.low) ? above : drive.piece;
    }
    case DrivePiece::upper: {
      const DrivePiece below = piece_between_limits(drive, bounds.high, most, DrivePiece::forwards);
      return law(below, bounds.high) < drive.impulse ? below : drive.piece;
    }
    case DrivePiece::driven:
      if (drive.speed < bounds.low) return DrivePiece::lower;
      if (bounds.high < drive.speed) return DrivePiece::upper;
      if (law(DrivePiece::forwards, drive.speed) < drive.impulse) return DrivePiece::forwards;
      return drive.impulse < law(DrivePiece::backwards, drive.speed) ? DrivePiece::backwards : drive.piece;
    default: break;
  }
  const bool passes = drive.driven && ((drive.piece == DrivePiece::forwards && drive.speed + slack < speed) ||
                                       (drive.piece == DrivePiece::backwards && speed < drive.speed - slack));
  // The motor's speed is the neighbour of full force where the limits allow it; a limit comes only after it.
  if (passes && !(drive.speed < bounds.low) && !(bounds.high < drive.speed)) return DrivePiece::driven;
  if (speed < bounds.low - slack) return DrivePiece::lower;
  if (bounds.high + slack < speed) return DrivePiece::upper;
  if (drive.servo) {
    const V asked = spring_impulse(drive, speed);
    if (drive.piece == DrivePiece::forwards) return asked + slack < most ? DrivePiece::free : drive.piece;
    if (drive.piece == DrivePiece::backwards) return slack - most < asked ? DrivePiece::free : drive.piece;
    return most + slack < asked ? DrivePiece::forwards : asked < -most - slack ? DrivePiece::backwards : drive.piece;
  }
  return passes ? DrivePiece::driven : drive.piece;
}

/// [m/s] Returns the distance of a drive from its law: the wrong speed, or the excess impulse.
template <class S>
ISO_INLINE Velocity<S> drive_residual(const JointDrive<S>& drive, Velocity<S> speed, const DriveBounds<S>& bounds,
                                      Velocity<S> most) {
  const DrivePiece next = next_piece(drive, speed, bounds, most);
  if (fixes_speed(next)) return abs(speed - fixed_speed(drive, next, bounds));
  const Velocity<S> spring = springs(drive, next) ? spring_impulse(drive, speed) : Velocity<S>(0);
  return abs(drive.impulse - motor_impulse(next, most) - spring);
}

}  // namespace detail

}  // namespace isostep
