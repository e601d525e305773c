// AeroSurface: a wing, sail, keel, rudder or hydrofoil as a tensor that turns the air's velocity into a force.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

using AeroSurfaceId = Id<struct AeroSurfaceTag>;

/// Applies a force at a point of the body: tensor v in the surface's frame, with v the velocity of that point through
/// the air, with the body's rotation, less the wind of the zones around it. A tensor that resists has negative entries.
/// An underwater surface uses the velocity through the Water around it, and has no force while the point is above it.
/// A control surface: control from -1 to 1 leads from `low` over `tensor` to `high`, linearly in between.
/// An angled surface: `orientation` turns its frame in the body's.
/// Source:  Millington 2007, pp. 217-222, 225-227. Differs: the wind is subtracted, the body's rotation counts, the
///          force may grow with the speed squared, and large tensors are stable.
template <class S> struct AeroSurface {
  BodyId body = {};
  Vec3<S> point = {S(0), S(0), S(0)};                     // [m] body frame
  Quat<Unit<S>> orientation = Quat<Unit<S>>::identity();  // surface's frame to body frame
  Mat3<S> tensor = Mat3<S>::diagonal(Vec3<S>::zero());    // [N s/m], or [N s^2/m^2] of |v| v
  Mat3<S> low = Mat3<S>::diagonal(Vec3<S>::zero());
  Mat3<S> high = Mat3<S>::diagonal(Vec3<S>::zero());
  S control = S(0);  // [1] -1 to 1
  bool is_quadratic = false;
  bool is_under_water = false;  // a keel, a water rudder, a hydrofoil

  ISO_FIELDS(body, point, orientation, tensor, low, high, control, is_quadratic, is_under_water)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> bool is_finite_matrix(const Mat3<S>& m) {
  return is_finite(m.rows[0]) && is_finite(m.rows[1]) && is_finite(m.rows[2]);
}

/// [N s/m] Returns the tensor at this control and, for a quadratic surface, at this speed [m/s] through the air.
template <class S> Mat3<S> tensor_of(const AeroSurface<S>& surface, S speed) {
  const Mat3<S>& end = surface.control < S(0) ? surface.low : surface.high;
  const S part = abs(surface.control), rest = S(1) - part;
  Mat3<S> tensor;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const S mixed = round_to<S>(product(surface.tensor.rows[i][j], rest) + product(end.rows[i][j], part));
      tensor.rows[i][j] = surface.is_quadratic ? saturate_to<S>(product(mixed, speed)) : mixed;
    }
  }
  return tensor;
}

template <class S> struct RecordRules<AeroSurface<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::resists;
  static FaultReport fault(const AeroSurface<S>& a) {
    constexpr const char *kFinite = "finite numbers", *kControl = "-1 to 1";
    return Checklist()
        .also(fault_of_place(a.point, "point"))
        .proper(is_unit<S>(a.orientation), "orientation", kUnitLength)
        .ask(is_finite_matrix(a.tensor), Fault::not_finite, "tensor", kFinite)
        .ask(is_finite_matrix(a.low), Fault::not_finite, "low", kFinite)
        .ask(is_finite_matrix(a.high), Fault::not_finite, "high", kFinite)
        .finite(a.control, "control")
        .proper(within(a.control, S(1)), "control", kControl)
        .report();
  }
  static constexpr NamedBodies<S> bodies(const AeroSurface<S>& a) { return named_point(a.body, a.point, "point"); }
  template <class Random> static void draw(AeroSurface<S>& a, Random& random) {
    a.body = random.body();
    const double mass = random.mass(a.body), unit = random.one_in(4) ? 100 * mass : mass;
    a.point = random.point(0.0625);
    a.orientation = random.turn();
    for (Mat3<S>* tensor : {&a.tensor, &a.low, &a.high}) {
      const S x = random.in(-2, 0, unit), y = random.in(-2, 0, unit);
      *tensor = Mat3<S>::diagonal({x, y, random.in(-2, 0, unit)});
    }
    a.control = random.in(-1, 1);
    a.is_quadratic = random.one_in(2);
    a.is_under_water = random.one_in(3);
  }
  template <class Forces> static void resist(const AeroSurface<S>& a, Forces& forces) {
    const auto end = forces.bodies.end_at(a.body, a.point);
    if (!forces.bodies.moves(end.row)) return;
    const Quat<Unit<S>> body = forces.bodies.state(end.row).orientation;
    const Mat3<Unit<S>> axes = to_matrix(normalise(body * a.orientation));
    Vec3<S> flow;
    if (!a.is_under_water) flow = forces.zones.wind_at(end.at);
    else if (!forces.wet.is_under_water(end.row, end.at, flow)) return;
    const Vec3<S> through = forces.resistance.next_velocity(end) - flow;
    // The speed of now, which in balance is that of next: what the others lead to is more.
    const Mat3<S> tensor = tensor_of(a, length(end.velocity - flow));
    forces.sums.push(end, axes * forces.resistance.settled(end, axes, tensor, transposed_times(axes, through)));
  }
};

}  // namespace isostep::detail
