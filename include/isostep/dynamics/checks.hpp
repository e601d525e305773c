// What numbers a world takes: the same rules for commands and for states read from files.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fault.hpp"
#include "isostep/core/slot_map.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/settings.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/validate.hpp"
#include "isostep/math/shortened.hpp"

namespace isostep::detail {

/// The most friction [1] and damping [1] of critical: far beyond real materials and useful springs. Products still fit.
template <class S> inline constexpr S kMaxFriction = S(16);
template <class S> inline constexpr S kMaxDampingRatio = S(64);
template <class S> inline constexpr S kMaxAngle = S(6.28318530717958647692);  // [rad] a joint's

template <class S> bool is_unit(const Quat<Unit<S>>& q) {
  const Pose<S> pose = {Vec3<S>::zero(), q};
  return validate(pose) == ShapeFault::none;
}
template <class S> ISO_INLINE bool is_direction(const Vec3<Unit<S>>& v) {
  return is_unit<S>(Quat<Unit<S>>{v.x, v.y, v.z, Unit<S>(0)});
}

/// Returns true if the length of v, not each component, is within the limit.
template <class S> bool no_longer(Vec3<S> v, S limit) { return !(limit < length(v)); }

/// Reports the fault of a refused shape.
ISO_INLINE FaultReport report_of(const ShapeFaultPlace& place) {
  if (place.fault == ShapeFault::none) return {};
  const Fault fault = place.fault == ShapeFault::not_finite ? Fault::not_finite : Fault::bad_shape;
  const bool of_all = place.fault == ShapeFault::no_children || place.fault == ShapeFault::too_many_triangles;
  if (of_all) return {fault, "", "children", expected_of(place.fault)};
  return {fault, "", place.field, expected_of(place.fault), place.child};
}

/// Checks a command's fields in order. The first requirement that is not met is the fault.
class Checklist {
 public:
  template <class T> ISO_INLINE Checklist& finite(const T& number, const char* field) {
    return ask(is_finite(number), Fault::not_finite, field, "a finite number");
  }
  ISO_INLINE Checklist& in_range(bool holds, const char* field, const char* expected) {
    return ask(holds, Fault::out_of_range, field, expected);
  }
  ISO_INLINE Checklist& proper(bool holds, const char* field, const char* expected) {
    return ask(holds, Fault::bad_argument, field, expected);
  }
  ISO_INLINE Checklist& ask(bool holds, Fault fault, const char* field, const char* expected) {
    if (!holds && report_ == Fault::none) report_ = {fault, "", field, expected};
    return *this;
  }
  ISO_INLINE Checklist& also(const FaultReport& report) {
    if (report_ == Fault::none) report_ = report;
    return *this;
  }
  ISO_INLINE const FaultReport& report() const { return report_; }

 private:
  FaultReport report_;
};

inline constexpr char kWithinSpeed[] = "a length up to Limits::speed()";
inline constexpr char kWithinAngularSpeed[] = "a length up to Limits::angular_speed()";
inline constexpr char kWithinPosition[] = "coordinates up to Limits::position()";
inline constexpr char kUnitLength[] = "a quaternion of length 1";
inline constexpr char kZeroOfStatic[] = "0 of a static body";

/// [1] Returns true if all factors are 1/64 to 1: the squares of quotients by them fit every scalar.
template <class S> bool is_grain(Vec3<S> factors) {
  const auto good = [](S f) { return S(kLeastGrain) <= f && f <= S(1); };
  return good(factors.x) && good(factors.y) && good(factors.z);
}

template <class S> FaultReport fault_of(const Material<S>& m) {
  return Checklist()
      .finite(m.friction, "material.friction")
      .finite(m.restitution, "material.restitution")
      .finite(m.rolling_resistance, "material.rolling_resistance")
      .finite(m.spin_resistance, "material.spin_resistance")
      .finite(m.surface_velocity, "material.surface_velocity")
      .finite(m.static_friction, "material.static_friction")
      .finite(m.anisotropy, "material.anisotropy")
      .in_range(no_longer(m.surface_velocity, Limits<S>::speed()), "material.surface_velocity", kWithinSpeed)
      .in_range(m.friction <= kMaxFriction<S>, "material.friction", "0 to 16")
      .in_range(m.static_friction <= kMaxFriction<S>, "material.static_friction", "0 to 16")
      .in_range(m.rolling_resistance <= Limits<S>::extent(), "material.rolling_resistance", "0 to Limits::extent()")
      .in_range(m.spin_resistance <= Limits<S>::extent(), "material.spin_resistance", "0 to Limits::extent()")
      .proper(S(0) <= m.friction, "material.friction", "0 to 16")
      .proper(S(0) <= m.restitution && m.restitution <= S(1), "material.restitution", "0 to 1")
      .proper(S(0) <= m.rolling_resistance, "material.rolling_resistance", "0 to Limits::extent()")
      .proper(S(0) <= m.spin_resistance, "material.spin_resistance", "0 to Limits::extent()")
      .proper(S(0) <= m.static_friction, "material.static_friction", "0 to 16")
      .proper(is_grain(m.anisotropy), "material.anisotropy", "1/64 to 1")
      .proper(m.reserved == 0, "material.reserved", "0")
      .report();
}
/// Checks the traits of a part. Fields that no flag names must be zero, or as in a new record.
template <class S> FaultReport fault_of(const PartTraits<S>& t) {
  const PartTraits<S> none = {};
  const bool has_material = t.has(part_flag::kOwnMaterial), has_filter = t.has(part_flag::kOwnFilter);
  return Checklist()
      .proper((t.flags & ~part_flag::kAll) == 0, "traits.flags", "bits of part_flag")
      .proper(has_filter || t.filter == none.filter || t.filter == Filter{}, "traits.filter", "0 without kOwnFilter")
      .proper(has_material || t.material == none.material || t.material == Material<S>{}, "traits.material",
              "0 without kOwnMaterial")
      .also(has_material ? fault_of(t.material) : FaultReport{})
      .report();
}

/// Checks gravity scale, damping and locks. The product of two numbers up to the speed limit fits.
template <class S>
FaultReport fault_of_motion(S gravity_scale, S linear_damping, S angular_damping, std::uint32_t locks) {
  const S most = S(kMaxRate);
  return Checklist()
      .finite(gravity_scale, "gravity_scale")
      .finite(linear_damping, "linear_damping")
      .finite(angular_damping, "angular_damping")
      .in_range(within(gravity_scale, Limits<S>::speed()), "gravity_scale", "a size up to Limits::speed()")
      .in_range(linear_damping <= most, "linear_damping", "0 to 16384")
      .in_range(angular_damping <= most, "angular_damping", "0 to 16384")
      .proper(S(0) <= linear_damping, "linear_damping", "0 to 16384")
      .proper(S(0) <= angular_damping, "angular_damping", "0 to 16384")
      .proper((locks & ~body_flag::kAllLocks) == 0, "locks", "body_flag::kLock... alone")
      .report();
}

/// Checks a mass for any type of body: a field that a static body does not use can still be wrong.
template <class S> FaultReport fault_of_signs(S density, S mass, Vec3<S> inertia) {
  const S zero = S(0);
  const bool positive = zero < inertia.x && zero < inertia.y && zero < inertia.z;
  return Checklist()
      .ask(zero <= mass, Fault::bad_mass, "mass", "above 0, or 0 for that of density")
      .ask(zero <= density, Fault::bad_mass, "density", "above 0")
      .ask(positive || inertia == Vec3<S>::zero(), Fault::bad_mass, "inertia",
           "about each axis above 0, or 0 about all for that of the shape")
      .report();
}

/// Checks mass and kappa. The limit is that of a solid of a few of the least sizes: a larger kappa is inertia out of
/// nowhere, and its products do not fit S.
template <class S> FaultReport fault_of_mass(S mass, Vec3<S> kappa) {
  const S most = S(3) / (Limits<S>::minimum_size() * Limits<S>::minimum_size());
  return Checklist()
      .finite(mass, "mass")
      .finite(kappa, "inertia")
      .ask(S(0) < mass && mass <= Limits<S>::mass(), Fault::bad_mass, "mass", "above 0, up to Limits::mass()")
      .ask(S(0) <= kappa.x && S(0) <= kappa.y && S(0) <= kappa.z && within(kappa, most), Fault::bad_mass, "inertia",
           "that of a solid of Limits::minimum_size() or more")
      .report();
}

/// Checks what joints and AxisDrives have in common: that limits and a spring's target are within `reach` [m] or [rad],
/// and the speed of a motor.
template <class S, class Drive> FaultReport fault_of_drive(const Drive& d, bool length, S reach, const char* expected) {
  return Checklist()
      .finite(d.lower, "lower")
      .finite(d.upper, "upper")
      .finite(d.motor_speed, "motor_speed")
      .finite(d.spring_target, "spring_target")
      .finite(d.spring_damping, "spring_damping")
      .in_range(within(d.lower, reach), "lower", expected)
      .in_range(within(d.upper, reach), "upper", expected)
      .in_range(within(d.spring_target, reach), "spring_target", expected)
      .in_range(within(d.motor_speed, length ? Limits<S>::speed() : Limits<S>::angular_speed()), "motor_speed",
                length ? "a size up to Limits::speed()" : "a size up to Limits::angular_speed()")
      .in_range(d.spring_damping <= kMaxDampingRatio<S>, "spring_damping", "0 to 64")
      .report();
}

/// Reports the fault of an id that names nothing.
template <class AnyId>
ISO_INLINE FaultReport fault_of_id(const SlotMap& slot_map, AnyId id, std::uint32_t space, const char* field) {
  if (slot_map.holds(id)) return {};
  if (!id) return {Fault::null_id, "", field, ""};
  return {SlotMap::space_of(id) != space ? Fault::foreign_id : Fault::stale_id, "", field, ""};
}

/// Returns true if a joint's arm is too long for its body. kappa arm^2 tells how much faster the joint's end responds
/// than the whole body, and rows multiply by it. About each principal axis only the arm's part across the axis counts,
/// so that a long rod may hang by its end.
template <class S> bool overreaches(Vec3<S> kappa, const Quat<Unit<S>>& principal, Vec3<S> arm) {
  const S most = Limits<S>::leverage();
  const Vec3<S> p = transposed_times(to_matrix(principal), arm);
  const auto too_long = [most](S k, S u, S v) {
    const S length = direction_of(S(0), u, v).length;
    return length <= S(1) ? most < (k * length) * length : (most / length) / length < k;
  };
  return too_long(kappa.x, p.y, p.z) || too_long(kappa.y, p.z, p.x) || too_long(kappa.z, p.x, p.y);
}

/// Returns true if points of the body would leave the range of velocities. `box` is that of the body.
template <class S> ISO_INLINE bool rotates_too_fast(Vec3<Velocity<S>> angular_velocity, const Aabb<S>& box) {
  const S reach = max_abs(box.high - box.low);  // twice the arm, roughly
  return product(convert<S>(Limits<S>::surface_speed()), S(1)) < product(reach, convert<S>(max_abs(angular_velocity)));
}

/// Rounds an exact sum to S, clamped to the ends of the format instead of wrapping.
template <class S, class Sum> ISO_INLINE S saturate_at(Sum sum, S highest) {
  const auto bound = product(highest, S(1));
  return bound < sum ? highest : sum < -bound ? -highest : round_to<S>(sum);
}

/// [1/s^2 of `limit`'s unit s] Returns the most that forces may accelerate: from rest to a limit in one step, and at
/// most half of the format, so that two add up.
template <class S> ISO_INLINE S most_acceleration(std::int32_t hz, S limit) {
  const S half = highest<S>() * S(0.5);
  return product(half, S(1)) < product(S(hz), limit) ? half : S(hz) * limit;
}

template <class S> ISO_INLINE FaultReport fault_of_place(Vec3<S> point, const char* field) {
  return Checklist()
      .finite(point, field)
      .in_range(within(point, Limits<S>::position()), field, kWithinPosition)
      .report();
}

/// Returns the moment of a force of any size that a user gave.
template <class S> ISO_INLINE Vec3<S> saturated_cross(Vec3<S> arm, Vec3<S> force) {
  const auto part = [](S a, S b, S c, S d)
                        ISO_INLINE_LAMBDA { return saturate_at<S>(product(a, b) - product(c, d), highest<S>()); };
  return {part(arm.y, force.z, arm.z, force.y), part(arm.z, force.x, arm.x, force.z),
          part(arm.x, force.y, arm.y, force.x)};
}

}  // namespace isostep::detail
