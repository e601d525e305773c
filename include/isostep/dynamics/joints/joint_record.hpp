// The record of a joint: properties, which commands change, and state, which the step changes. Kinds: joint_type.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/joints/joint_type.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// Bits of JointProperties::flags.
namespace joint_flag {
inline constexpr std::uint32_t kCollideConnected = 1u << 0;  // the two bodies have contacts with each other
inline constexpr std::uint32_t kLimit = 1u << 1;             // lower..upper holds
inline constexpr std::uint32_t kMotor = 1u << 2;
inline constexpr std::uint32_t kSpring = 1u << 3;
inline constexpr std::uint32_t kCone = 1u << 4;   // cone holds
inline constexpr std::uint32_t kLockX = 1u << 8;  // of a six-axis joint: the axes of JointAxis, in their order
inline constexpr std::uint32_t kLockY = 1u << 9;
inline constexpr std::uint32_t kLockZ = 1u << 10;
inline constexpr std::uint32_t kLockSwingX = 1u << 11;
inline constexpr std::uint32_t kLockSwingY = 1u << 12;
inline constexpr std::uint32_t kLockTwist = 1u << 13;
inline constexpr std::uint32_t kLockPoint = kLockX | kLockY | kLockZ;
inline constexpr std::uint32_t kLockSwing = kLockSwingX | kLockSwingY;
inline constexpr std::uint32_t kLockTurns = kLockSwing | kLockTwist;
}  // namespace joint_flag

inline constexpr std::uint32_t kNoBody = 0xffffffffu;  // as a joint's body: the world

/// The piece of its law that a drive is on. It is kept from step to step, as the first guess of the next sub-step.
enum class DrivePiece : std::uint32_t {
  free,      // between the limits, no motor
  lower,     // stopped at the lower limit
  upper,     // stopped at the upper limit
  driven,    // at the motor's speed
  forwards,  // slower than the motor wants: it gives all that it has
  backwards  // faster than the motor wants: it brakes with all that it has
};
inline constexpr std::uint32_t kDrivePieces = 6;
inline constexpr std::uint32_t kJointRows = 6;  // two blocks of three

/// The part of a joint that the step changes: impulses as velocity changes of the pair's reduced mass, one for each of
/// its six rows, equality or drive.
template <class S> struct JointState {
  std::uint32_t slot;         // of its id
  std::uint32_t pieces;       // four bits a row: 0 where no drive is, else its DrivePiece and 1
  Vec3<Velocity<S>> point;    // [m/s] world, on b; of kinds that slide along the axes of a; distance: x along the joint
  Vec3<Velocity<S>> angular;  // [m/s] on b about the axes of frame a, times the row's radius

  ISO_INLINE constexpr bool has_drive(std::uint32_t row) const { return role(row) != 0; }
  /// Returns the piece of a row that has a drive.
  ISO_INLINE constexpr DrivePiece piece(std::uint32_t row) const { return static_cast<DrivePiece>(role(row) - 1); }
  ISO_INLINE constexpr void set_piece(std::uint32_t row, DrivePiece piece) {
    pieces |= (static_cast<std::uint32_t>(piece) + 1) << (4 * row);
  }
  /// Returns true if set_piece() can have written the bits of every row.
  ISO_INLINE constexpr bool has_known_pieces() const {
    for (std::uint32_t row = 0; row < kJointRows; ++row) {
      if (kDrivePieces < role(row)) return false;
    }
    return pieces >> (4 * kJointRows) == 0;
  }

  ISO_FIELDS(slot, pieces, point, angular)

 private:
  ISO_INLINE constexpr std::uint32_t role(std::uint32_t row) const { return pieces >> (4 * row) & 15u; }
};

/// The part of a joint that only commands change. Angles: [rad] of frame b against frame a about z, in (-pi, pi].
template <class S> struct JointProperties {
  JointType type = JointType::ball;
  std::uint32_t flags = 0;         // joint_flag
  std::uint32_t body_a = kNoBody;  // slots
  std::uint32_t body_b = kNoBody;
  std::uint32_t generation_a = 0;  // of the bodies' ids: checked when the joint is made
  std::uint32_t generation_b = 0;
  std::uint64_t user_data = 0;
  Pose<S> frame_a = Pose<S>::identity();  // from the centre of mass, body axes; for the world its own frame
  Pose<S> frame_b = Pose<S>::identity();
  S lower = S(0);  // [rad] or [m]: the kind's JointMeasure
  S upper = S(0);
  S cone = S(0);              // [rad] largest angle between the z axes
  S motor_speed = S(0);       // [rad/s] or [m/s] of b against a
  S max_force = S(0);         // [N m] or [N] most that the motor gives; less where in one sub-step it would turn the
                              // bodies, were they free, beyond Limits<S>::surface_speed()
  S spring_target = S(0);     // [rad] or [m], as lower
  S spring_frequency = S(0);  // [Hz] up to half the sub-step rate; a spring's swing lasts up to 0.25 rad a sub-step
  S spring_damping = S(0);    // [1] ratio, 1 = critical

  /// Takes all settings that may change after creation: all but the kind, the bodies and the frames.
  ISO_INLINE constexpr void take_settings(const JointProperties& from) {
    flags = from.flags;
    user_data = from.user_data;
    lower = from.lower;
    upper = from.upper;
    cone = from.cone;
    motor_speed = from.motor_speed;
    max_force = from.max_force;
    spring_target = from.spring_target;
    spring_frequency = from.spring_frequency;
    spring_damping = from.spring_damping;
  }

  ISO_FIELDS(type, flags, body_a, body_b, generation_a, generation_b, user_data, frame_a, frame_b, lower, upper, cone,
             motor_speed, max_force, spring_target, spring_frequency, spring_damping)
};

static_assert(kHasNoPadding<JointState<float>> && kHasNoPadding<JointState<double>>);
static_assert(kHasNoPadding<JointState<Q16_16>> && kHasNoPadding<JointState<Q32_32>>);
static_assert(kHasNoPadding<JointProperties<float>> && kHasNoPadding<JointProperties<double>>);
static_assert(kHasNoPadding<JointProperties<Q16_16>> && kHasNoPadding<JointProperties<Q32_32>>);

}  // namespace isostep
