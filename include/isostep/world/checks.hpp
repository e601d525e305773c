// What numbers a world takes: the same rules for commands and for states read from files.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/validate.hpp"
#include "isostep/world/events.hpp"
#include "isostep/world/settings.hpp"

namespace isostep::detail {

/// [1] and [1] of critical: far beyond any pair of materials and any useful spring; products with them still fit.
template <class S> inline constexpr S kMaxFriction = S(16);
template <class S> inline constexpr S kMaxDampingRatio = S(64);
template <class S> inline constexpr S kMaxAngle = S(6.28318530717958647692);  // [rad] a joint's

/// From -limit to limit. By comparison on both sides: the lowest fixed-point number has no magnitude.
template <class S> ISO_INLINE bool within(S x, S limit) { return -limit <= x && x <= limit; }
template <class S> ISO_INLINE bool within(Vec3<S> v, S limit) {
  return within(v.x, limit) && within(v.y, limit) && within(v.z, limit);
}
template <class S> bool is_unit(const Quat<Unit<S>>& q) {
  const Pose<S> pose = {Vec3<S>::zero(), q};
  return validate(pose) == ShapeFault::none;
}

template <class S> Fault fault_of(const Material<S>& m) {
  if (!is_finite(m.friction) || !is_finite(m.restitution) || !is_finite(m.rolling_resistance) ||
      !is_finite(m.surface_velocity)) {
    return Fault::not_finite;
  }
  if (!within(m.surface_velocity, Limits<S>::speed()) || kMaxFriction<S> < m.friction ||
      Limits<S>::extent() < m.rolling_resistance) {
    return Fault::out_of_range;
  }
  const bool good =
      S(0) <= m.friction && S(0) <= m.restitution && m.restitution <= S(1) && S(0) <= m.rolling_resistance;
  return good ? Fault::none : Fault::bad_argument;
}

/// A factor of gravity: the product of two numbers up to the speed limit fits.
template <class S> Fault fault_of_motion(S gravity_scale, S linear_damping, S angular_damping, std::uint32_t locks) {
  if (!is_finite(gravity_scale) || !is_finite(linear_damping) || !is_finite(angular_damping)) return Fault::not_finite;
  const S speed = Limits<S>::speed();
  if (!within(gravity_scale, speed) || S(kMaxRate) < linear_damping || S(kMaxRate) < angular_damping)
    return Fault::out_of_range;
  const bool good = S(0) <= linear_damping && S(0) <= angular_damping && (locks & ~body_flag::kAllLocks) == 0;
  return good ? Fault::none : Fault::bad_argument;
}

/// Kappa of a solid no smaller than a few of the least sizes: larger is inertia out of nowhere, and its products leave
/// S.
template <class S> Fault fault_of_mass(S mass, Vec3<S> kappa) {
  if (!is_finite(mass) || !is_finite(kappa)) return Fault::not_finite;
  const S most = S(3) / (Limits<S>::minimum_size() * Limits<S>::minimum_size());
  const bool good = S(0) < mass && mass <= Limits<S>::mass() && S(0) <= kappa.x && S(0) <= kappa.y && S(0) <= kappa.z &&
                    within(kappa, most);
  return good ? Fault::none : Fault::bad_mass;
}

/// `substep_rate` [1/s].
template <class S> Fault fault_of(const JointProperties<S>& j, std::int32_t substep_rate) {
  const S numbers[] = {
      j.lower, j.upper, j.cone, j.motor_speed, j.motor_torque, j.spring_target, j.spring_frequency, j.spring_damping};
  for (const S number : numbers) {
    if (!is_finite(number)) return Fault::not_finite;
  }
  for (const Pose<S>& frame : {j.frame_a, j.frame_b}) {
    if (!is_finite(frame.position)) return Fault::not_finite;
    if (!within(frame.position, Limits<S>::position())) return Fault::out_of_range;
    if (!is_unit<S>(frame.orientation)) return Fault::bad_argument;
  }
  const bool distance = j.type == JointType::distance;
  const S reach = distance ? Limits<S>::position() : kMaxAngle<S>;
  if (!within(j.lower, reach) || !within(j.upper, reach) || !within(j.cone, kMaxAngle<S>) ||
      !within(j.spring_target, reach) || !within(j.motor_speed, Limits<S>::spin()) ||
      kMaxDampingRatio<S> < j.spring_damping) {
    return Fault::out_of_range;
  }
  const bool sprung = (j.flags & joint_flag::kSpring) != 0;
  const S nyquist = S(substep_rate) * S(0.5);
  const bool good_spring =
      !sprung || (S(0) < j.spring_frequency && j.spring_frequency <= nyquist && S(0) <= j.spring_damping);
  const bool good = j.type <= JointType::distance && j.lower <= j.upper && S(0) <= j.motor_torque &&
                    (j.flags & ~0x1fu) == 0 && good_spring && (!distance || S(0) <= j.lower);
  return good ? Fault::none : Fault::bad_argument;
}

/// Whether a joint's arm is too long for its body: kappa arm^2 is how much faster the joint's end answers than the body
/// as a whole, and rows multiply by it. About each principal axis only the arm's part across it counts, so that a long
/// rod may hang by its end.
template <class S> bool overreaches(Vec3<S> kappa, const Quat<Unit<S>>& principal, Vec3<S> arm) {
  const S most = Limits<S>::leverage();
  const Vec3<S> p = transposed_times(to_matrix(principal), arm);
  const auto too_long = [most](S k, S u, S v) {
    const S length = direction_of(S(0), u, v).length;
    return length <= S(1) ? most < (k * length) * length : (most / length) / length < k;
  };
  return too_long(kappa.x, p.y, p.z) || too_long(kappa.y, p.z, p.x) || too_long(kappa.z, p.x, p.y);
}

/// Spin so fast that points of the body leave the range of velocities. `box` is the body's.
template <class S> bool overspins(Vec3<Velocity<S>> spin, const Aabb<S>& box) {
  const S reach = max_abs(box.high - box.low);  // twice the arm, roughly
  return product(convert<S>(Limits<S>::surface_speed()), S(1)) < product(reach, convert<S>(max_abs(spin)));
}

/// An exact sum as an S, held at the ends of the format instead of wrapping.
template <class S, class Sum> S saturate_at(Sum sum, S highest) {
  const auto bound = product(highest, S(1));
  return bound < sum ? highest : sum < -bound ? -highest : round_to<S>(sum);
}

/// [1/s^2 of `limit`'s unit s] What forces may do: from rest to a limit in one step, and no more than half of the format,
/// so that two add up.
template <class S> S most_acceleration(std::int32_t hz, S limit) {
  const S half = highest<S>() * S(0.5);
  return product(half, S(1)) < product(S(hz), limit) ? half : S(hz) * limit;
}

template <class S> Fault fault_of_place(Vec3<S> point) {
  if (!is_finite(point)) return Fault::not_finite;
  return within(point, Limits<S>::position()) ? Fault::none : Fault::out_of_range;
}

/// The moment of a force that a user gave, whatever its size.
template <class S> Vec3<S> saturated_cross(Vec3<S> arm, Vec3<S> force) {
  const auto part = [](S a, S b, S c, S d) { return saturate_at<S>(product(a, b) - product(c, d), highest<S>()); };
  return {part(arm.y, force.z, arm.z, force.y), part(arm.z, force.x, arm.x, force.z),
          part(arm.x, force.y, arm.y, force.x)};
}

}  // namespace isostep::detail
