// A rigid body as it is stored: what moves every step, and what only commands change.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/geometry/part_traits.hpp"
#include "isostep/math/aabb.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

enum class BodyType : std::uint32_t {
  static_,    // never moves: no velocity, infinite mass
  kinematic,  // moves as told: velocity given, infinite mass
  dynamic     // moves by forces and contacts
};
inline constexpr BodyType dynamic = BodyType::dynamic;
inline constexpr BodyType kinematic = BodyType::kinematic;

/// Bits of BodyProperties::flags.
namespace body_flag {
inline constexpr std::uint32_t kSensor = 1u << 0;  // reports overlaps, is not solved
inline constexpr std::uint32_t kAllowSleep = 1u << 1;
inline constexpr std::uint32_t kCollide = 1u << 2;   // has contacts at all
inline constexpr std::uint32_t kSpins = 1u << 3;     // inertia differs between axes: the gyroscopic term matters
inline constexpr std::uint32_t kBullet = 1u << 4;    // continuous collision with what moves, too
inline constexpr std::uint32_t kDisabled = 1u << 5;  // takes no part until it is enabled again
inline constexpr std::uint32_t kReportContacts = 1u << 6;  // its contacts tell when they begin and end
inline constexpr std::uint32_t kLockX = 1u << 8;     // no motion along world x; then y, z, and turning about x, y, z
inline constexpr std::uint32_t kLockAngularX = 1u << 11;
inline constexpr std::uint32_t kAngularLocks = 7u * kLockAngularX;
inline constexpr std::uint32_t kAllLocks = 0x3fu << 8;
}  // namespace body_flag

/// The part of a body that the step changes.
template <class S> struct BodyState {
  std::uint32_t slot;                  // of its id
  std::uint32_t sleep_clock;           // steps spent slower than the sleep speed
  Vec3<S> centre;                      // [m] centre of mass, world
  Quat<Unit<S>> orientation;           // body frame to world
  Vec3<Velocity<S>> velocity;          // [m/s] of the centre of mass
  Vec3<Velocity<S>> angular_velocity;  // [rad/s] world
  Aabb<S> fat;                         // [m] bounds plus margin: renewed when the body leaves them

  ISO_FIELDS(slot, sleep_clock, centre, orientation, velocity, angular_velocity, fat)
};

/// The part of a body that only commands change.
template <class S> struct BodyProperties {
  BodyType type;
  std::uint32_t flags;  // body_flag
  std::uint32_t shape;  // slot of its shape
  Filter filter;
  std::uint64_t user_data;
  S mass;         // [kg]
  Vec3<S> kappa;  // [1/m^2] mass times inverse inertia, principal axes: geometry alone, so never far from 1/size^2
  Quat<Unit<S>> principal;  // principal axes to body frame
  Vec3<S> local_centre;     // [m] centre of mass, body frame
  Material<S> material;
  S gravity_scale;    // [1]
  S linear_damping;   // [1/s]
  S angular_damping;  // [1/s]
  S reserved;         // 0: keeps records of 4-byte scalars without padding

  ISO_FIELDS(type, flags, shape, filter, user_data, mass, kappa, principal, local_centre, material, gravity_scale,
             linear_damping, angular_damping, reserved)
};

template <class S> ISO_INLINE constexpr bool is_enabled(const BodyProperties<S>& body) {
  return (body.flags & body_flag::kDisabled) == 0;
}
/// Returns true if a body lies among the static ones: it does not move, and nothing moves it.
template <class S> ISO_INLINE constexpr bool is_fixed(const BodyProperties<S>& body) {
  return body.type == BodyType::static_ || !is_enabled(body);
}

static_assert(kHasNoPadding<BodyState<float>> && kHasNoPadding<BodyState<double>>);
static_assert(kHasNoPadding<BodyProperties<float>> && kHasNoPadding<BodyProperties<double>>);

}  // namespace isostep
