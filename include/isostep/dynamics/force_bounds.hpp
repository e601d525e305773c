// Bounder<S>: what forces and impulses of any size do within the range of a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"

namespace isostep::detail {

/// Forces and impulses have no range of their own. A Bounder cuts their effect to the scalar's range, on exact
/// products, so that nothing wraps, and remembers it for the report of the step.
template <class S> struct Bounder {
  using V = Velocity<S>;
  bool cut = false;

  ISO_INLINE S held(S x, S limit) {
    cut = cut || limit < x || x < -limit;
    return clamp(x, -limit, limit);
  }
  template <class Sum> ISO_INLINE S rounded(Sum sum, S limit) {
    const auto bound = product(limit, S(1));
    cut = cut || bound < sum || sum < -bound;
    return saturate_at<S>(sum, limit);
  }
  ISO_INLINE S quotient(S x, S divisor, S limit) {
    const auto value = product(x, S(1)), bound = product(limit, divisor);
    if (bound < value || value < -bound) {
      cut = true;
      return S(0) < x ? limit : -limit;
    }
    return held(x / divisor, limit);
  }
  ISO_INLINE Vec3<S> quotient(Vec3<S> v, S divisor, S limit) {
    return {quotient(v.x, divisor, limit), quotient(v.y, divisor, limit), quotient(v.z, divisor, limit)};
  }
  ISO_INLINE Vec3<S> times(const Mat3<S>& m, Vec3<S> v, S limit) {
    return {rounded(dot_sum(m.rows[0], v), limit), rounded(dot_sum(m.rows[1], v), limit),
            rounded(dot_sum(m.rows[2], v), limit)};
  }
  ISO_INLINE Vec3<S> sum(Vec3<S> a, Vec3<S> b, S limit) {  // twice the limit fits
    return {held(a.x + b.x, limit), held(a.y + b.y, limit), held(a.z + b.z, limit)};
  }
  ISO_INLINE Vec3<V> faster(Vec3<V> a, Vec3<S> b, S limit) {
    const V most = convert<V>(limit);
    const auto part = [&](V x, S y) ISO_INLINE_LAMBDA {
      const V total = x + convert<V>(y);
      cut = cut || most < total || total < -most;
      return clamp(total, -most, most);
    };
    return {part(a.x, b.x), part(a.y, b.y), part(a.z, b.z)};
  }
  /// Returns the effect of a torque or an angular impulse. Moments beyond the format end at its highest value.
  ISO_INLINE Vec3<S> turning(const Mat3<S>& kappa, Vec3<S> torque, S mass, S limit) {
    cut = cut || max_abs(torque) == highest<S>();
    return times(kappa, quotient(torque, mass, Limits<S>::mass()), limit);
  }
};

/// [rad/s] Returns half of the speed at which points of the body, with that box, leave the range of velocities.
template <class S> ISO_INLINE S most_angular_speed(const Aabb<S>& box) {
  return min(Limits<S>::angular_speed(), S(0.5) * Limits<S>::surface_speed() / max(S(1), max_abs(box.high - box.low)));
}

}  // namespace isostep::detail
