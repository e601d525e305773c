// Carrying: a kinematic body that turns takes what stands on it along its arc, and not along the tangent of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/quat.hpp"

namespace isostep {

/// A kinematic body that turns. Friction brings a rider to the speed w x d of its place at the start of a step. Kept
/// for the whole step, that leads off the circle: its radius grows as exp(w^2 t / (2 hz)), sub-steps or not. In a
/// sub-step of h the place under the rider itself moves to R (d + D), so friction aims at (R - 1) (d + D) / h. The
/// difference from w x d acts as a belt on the platform's surface.
/// Symbols: w = angular velocity [rad/s], d = from the platform's centre of mass to the rider's at the start of the
///          step [m], D = the change of d since then [m], R = 1 + 2 u [v]x + 2 [v]x^2 for the quaternion (v, u) of a
///          sub-step's turn.
template <class S> struct Carrier {
  using V = Velocity<S>;
  std::uint32_t row;         // of SolverBodies
  Vec3<V> angular_velocity;  // [rad/s]
  Mat3<V> added;             // [1/s] (R - 1) / h - [w]x

  /// Returns the carrier of a row. `turn` [rad] is the turn of BodyRows::integrate_positions over 1 / `rate` seconds.
  static ISO_INLINE Carrier of(std::uint32_t row, Vec3<V> angular_velocity, Vec3<Unit<S>> turn, std::int32_t rate) {
    const Quat<Unit<S>> q = integrate(Quat<Unit<S>>::identity(), turn);
    const auto part = [](Unit<S> a, S b) { return round_to<V>(product(a, b)); };
    const auto twice = [&](Unit<S> a) { return round_to<S>(product(a, S(2) * S(rate))); };
    const Vec3<S> v = {twice(q.x), twice(q.y), twice(q.z)};
    const Vec3<V> w = Vec3<V>{part(q.w, v.x), part(q.w, v.y), part(q.w, v.z)} - angular_velocity;
    const V xx = part(q.x, v.x), yy = part(q.y, v.y), zz = part(q.z, v.z);
    const V xy = part(q.x, v.y), xz = part(q.x, v.z), yz = part(q.y, v.z);
    return {row,
            angular_velocity,
            {{{-yy - zz, xy - w.z, xz + w.y}, {xy + w.z, -xx - zz, yz - w.x}, {xz - w.y, yz + w.x, -xx - yy}}}};
  }
};

/// A contact on a carrier, or on a turning belt: the surface of a SurfaceVelocity that turns while its body does not.
/// For a belt the whole (R - 1) (d + D) / h acts on the surface: its w x d is in `belt`.
template <class S> struct Carried {
  using V = Velocity<S>;
  std::uint32_t contact;
  std::uint32_t rider;  // row of SolverBodies
  Carrier<S> carrier;
  Vec3<S> place;                   // [m] d
  Vec3<S> belt;                    // [m/s] of the material and the belts
  bool on_b;                       // the carrier is b
  Vec3<V> spin = Vec3<V>::zero();  // [rad/s] of b's surface against a's, besides the bodies' own

  ISO_INLINE bool spins() const { return !(spin == Vec3<V>::zero()); }
  /// [m/s] Returns the surface's speed `arm` [m] away from the middle of the contact, less that in the middle.
  ISO_INLINE Vec3<V> spun(Vec3<S> arm) const {
    const auto part = [&](int i, int j) ISO_INLINE_LAMBDA {
      return saturate_to<V>(product(spin[i], arm[j]) - product(spin[j], arm[i]));
    };
    return held_within(Vec3<V>{part(1, 2), part(2, 0), part(0, 1)}, convert<V>(Limits<S>::speed()));
  }

  /// [m/s] Returns the speed of b's surface against a's in the sub-step that begins.
  ISO_INLINE Vec3<V> surface(const SolverBodies<S>& bodies) const {
    const Vec3<V> moved = bodies.displacement[rider].linear - bodies.displacement[carrier.row].linear;
    const Vec3<S> at = place + convert<S>(moved);
    const Vec3<V> w = carrier.angular_velocity;
    const auto part = [&](int i, V u, V v) ISO_INLINE_LAMBDA {
      const auto turned = product(w[(i + 1) % 3], v) - product(w[(i + 2) % 3], u);
      return round_to<V>(dot_sum(carrier.added.rows[i], at)) + round_to<V>(turned);
    };
    const Vec3<V> carried = {part(0, moved.y, moved.z), part(1, moved.z, moved.x), part(2, moved.x, moved.y)};
    const Vec3<V> held = held_within(carried, convert<V>(Limits<S>::speed()));
    return convert<V>(belt) + (on_b ? held : -held);
  }
};

}  // namespace isostep
