// The enumerations and flags of the C interface: their names in C, and how many enumerators each has.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "family.hpp"
#include "isostep/collision/broadphase/broad_phase_name.hpp"
#include "isostep/core/fault.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/dynamics/joints/joint_type.hpp"
#include "isostep/dynamics/projection.hpp"
#include "isostep/dynamics/records/record_store.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/geometry/shape_type.hpp"
#include "isostep/state/verify.hpp"
#include "isostep/store/query_types.hpp"
#include "isostep/store/stages.hpp"

namespace isostep::c {

/// Names of enumerators by number. In C: ISO_ENUM_NAME.
template <class E> struct Enumerators;

// clang-format off
#define ISO_ENUM(E, name, ...)                                            \
  template <> struct Enumerators<E> {                                     \
    static constexpr const char* kName = #name;                           \
    static constexpr const char* kNames[] = {__VA_ARGS__};                \
    static constexpr std::uint32_t kCount = sizeof kNames / sizeof *kNames; \
  };
ISO_ENUM(ScalarName, scalar, "f32", "f64", "q16", "q32")
ISO_ENUM(BodyType, body_type, "static", "kinematic", "dynamic")
ISO_ENUM(Footing, footing, "airborne", "floor", "steep")
ISO_ENUM(StartInside, start_inside, "report", "ignore")
ISO_ENUM(HitPer, hit_per, "body", "child", "triangle")
ISO_ENUM(BlobHome, blob_home, "carried", "asset")
ISO_ENUM(VerifyOutcome, verify_outcome, "verified", "diverged", "incompatible", "truncated", "corrupt", "stopped")
ISO_ENUM(VerifyResult::Where, verify_where, "start", "frame", "keyframe")
ISO_ENUM(Fault, fault, "none", "stale_id", "not_finite", "out_of_range", "bad_shape", "bad_mass", "bad_argument",
         "shape_in_use", "not_dynamic", "null_id", "foreign_id", "bad_snapshot", "called_in_step")
#define ISO_LISTED(name, ...) #name,
ISO_ENUM(ShapeType, shape_type, ISO_FOR_EACH_SHAPE(ISO_LISTED))
ISO_ENUM(JointType, joint_type, ISO_FOR_EACH_JOINT(ISO_LISTED))
ISO_ENUM(SolverName, solver, ISO_FOR_EACH_SOLVER(ISO_LISTED))
ISO_ENUM(Projection, projection, ISO_FOR_EACH_PROJECTION(ISO_LISTED))
ISO_ENUM(BroadPhaseName, broad_phase, ISO_FOR_EACH_BROAD_PHASE(ISO_LISTED))
ISO_ENUM(Simd, simd, "best", ISO_FOR_EACH_SIMD(ISO_LISTED, ))
#undef ISO_LISTED
#undef ISO_ENUM
// clang-format on

#define ISO_NAMED_ENUM(E, name, names)                                      \
  template <> struct Enumerators<E> {                                       \
    static constexpr const char* kName = #name;                             \
    static constexpr const auto& kNames = names;                            \
    static constexpr std::uint32_t kCount = sizeof kNames / sizeof *kNames; \
  };
ISO_NAMED_ENUM(Stage, stage, kStageNames)
ISO_NAMED_ENUM(JointAxis, joint_axis, kJointAxisNames)
ISO_NAMED_ENUM(ZoneShape, zone_shape, kZoneShapeNames)
ISO_NAMED_ENUM(BreakPattern, break_pattern, kBreakPatternNames)
#undef ISO_NAMED_ENUM
static_assert(Enumerators<Fault>::kCount == kFaults);

/// Lists all enumerations, for the program that writes the header.
#define ISO_C_ENUMS(X)                                                                                                 \
  X(ScalarName)                                                                                                        \
  X(BodyType)                                                                                                          \
  X(ShapeType) X(JointType) X(JointAxis) X(SolverName) X(Projection) X(BroadPhaseName) X(Simd) X(ZoneShape)            \
      X(BreakPattern) X(Footing) X(StartInside) X(HitPer) X(BlobHome) X(Fault) X(VerifyOutcome) X(VerifyResult::Where) \
          X(Stage)

/// A bit of a flags member. In C: ISO_SET_NAME.
struct Flag {
  const char* name;
  std::uint32_t bits;
};
struct FlagSet {
  const char* name;
  std::span<const Flag> flags;
};
inline constexpr Flag kBodyFlags[] = {{"sensor", body_flag::kSensor},
                                      {"allow_sleep", body_flag::kAllowSleep},
                                      {"collide", body_flag::kCollide},
                                      {"bullet", body_flag::kBullet},
                                      {"disabled", body_flag::kDisabled},
                                      {"report_contacts", body_flag::kReportContacts},
                                      {"lock_x", body_flag::kLockX},
                                      {"lock_y", body_flag::kLockX << 1},
                                      {"lock_z", body_flag::kLockX << 2},
                                      {"lock_angular_x", body_flag::kLockAngularX},
                                      {"lock_angular_y", body_flag::kLockAngularX << 1},
                                      {"lock_angular_z", body_flag::kLockAngularX << 2},
                                      {"all_locks", body_flag::kAllLocks}};
inline constexpr Flag kPartFlags[] = {{"own_material", part_flag::kOwnMaterial},
                                      {"own_filter", part_flag::kOwnFilter},
                                      {"sensor", part_flag::kSensor},
                                      {"report_contacts", part_flag::kReportContacts}};
inline constexpr Flag kJointFlags[] = {{"collide_connected", joint_flag::kCollideConnected},
                                       {"limit", joint_flag::kLimit},
                                       {"motor", joint_flag::kMotor},
                                       {"spring", joint_flag::kSpring},
                                       {"cone", joint_flag::kCone},
                                       {"lock_x", joint_flag::kLockX},
                                       {"lock_y", joint_flag::kLockY},
                                       {"lock_z", joint_flag::kLockZ},
                                       {"lock_swing_x", joint_flag::kLockSwingX},
                                       {"lock_swing_y", joint_flag::kLockSwingY},
                                       {"lock_twist", joint_flag::kLockTwist},
                                       {"lock_point", joint_flag::kLockPoint},
                                       {"lock_swing", joint_flag::kLockSwing},
                                       {"lock_turns", joint_flag::kLockTurns}};
inline constexpr Flag kZoneEffects[] = {{"acceleration", zone_effect::kAcceleration},
                                        {"wind", zone_effect::kWind},
                                        {"gravity", zone_effect::kGravity},
                                        {"water", zone_effect::kWater}};
inline constexpr FlagSet kFlagSets[] = {
    {"body_flag", kBodyFlags}, {"part_flag", kPartFlags}, {"joint_flag", kJointFlags}, {"zone_effect", kZoneEffects}};

}  // namespace isostep::c
