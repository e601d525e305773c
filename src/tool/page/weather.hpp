// Weather: wind, water and the forces of surfaces at a world's moment, for drawing.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include "isostep/math/transform.hpp"
#include "isostep/store/state.hpp"
#include "isostep/world/world.hpp"

namespace isostep::tool::page {

using Vector = Vec3<double>;

inline constexpr double kTurn = 2 * std::numbers::pi;  // [rad]

template <class T> Vector in_double(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class T> Mat3<double> in_double(const Mat3<T>& m) {
  return {{in_double(m.rows[0]), in_double(m.rows[1]), in_double(m.rows[2])}};
}
template <class T> Quat<double> in_double(Quat<T> q) {
  return {to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)};
}

/// visit(id, record) of all that are there, ascending by slot.
template <class Record, class IdType, class Visit>
void for_each_record(const Registry<Record, IdType>& registry, const Visit& visit) {
  for (const IdType id : registry.slot_map().template ids<IdType>()) visit(id, *registry.find(id));
}

/// Tensor of a surface at its control.
template <class S> Mat3<double> mixed_tensor(const AeroSurface<S>& surface) {
  const double control = to_double(surface.control), part = std::fabs(control);
  const Mat3<double> end = in_double(control < 0 ? surface.low : surface.high), middle = in_double(surface.tensor);
  Mat3<double> mixed;
  for (int i = 0; i < 3; ++i) mixed.rows[i] = middle.rows[i] * (1 - part) + end.rows[i] * part;
  return mixed;
}

/// The records' own formulas, in double, at the velocities that the step left. The step itself takes what a force leads
/// to within a sub-step, and holds everything within limits: forces differ by as much as a sub-step changes them.
template <class S> class Weather {
 public:
  explicit Weather(const World<S>& world) : world_(world), records_(*world.state().records) {
    const Vector gravity = in_double(world.settings().gravity);
    if (const double size = length(gravity); size > 0) up_ = -gravity / size;
    seconds_ = static_cast<double>(world.tick()) / world.settings().hz;
  }

  /// The direction against gravity; zero without it.
  Vector up() const { return up_; }

  /// [N] World axes, on the surface's body at its point.
  Vector force_of(const AeroSurface<S>& surface) const {
    if (!acts_on(surface.body)) return Vector::zero();
    const Quat<double> turn = in_double(world_.pose(surface.body).orientation);
    const Vector at = in_double(world_.pose(surface.body).position) + turned(turn, in_double(surface.point));
    Vector flow = Vector::zero();
    if (!surface.is_under_water) flow = wind_at(at);
    else if (!is_under_water(at, flow)) return Vector::zero();
    const Vector arm = at - in_double(world_.center_of_mass(surface.body));
    const Vector spin = in_double(world_.angular_velocity(surface.body));
    const Vector through = in_double(world_.velocity(surface.body)) + cross(spin, arm) - flow;
    const Mat3<double> axes = to_matrix(normalise(turn * in_double(surface.orientation)));
    const Vector force = axes * (mixed_tensor(surface) * transposed_times(axes, through));
    return surface.is_quadratic ? force * length(through) : force;
  }
  Vector force_of(const Thruster<S>& thruster) const {
    if (!acts_on(thruster.body)) return Vector::zero();
    return turned(in_double(world_.pose(thruster.body).orientation), in_double(thruster.force));
  }

 private:
  static Vector turned(const Quat<double>& turn, Vector v) { return to_matrix(normalise(turn)) * v; }
  static bool is_within(Vector v, Vector half) {
    return std::fabs(v.x) <= half.x && std::fabs(v.y) <= half.y && std::fabs(v.z) <= half.z;
  }
  bool acts_on(BodyId body) const {
    const BodyView<S> view = world_.view(body);
    return view.state != nullptr && view.properties->type == BodyType::dynamic;
  }

  Vector wind_at(Vector point) const {
    Vector wind = Vector::zero();
    for_each_record(records_.force_zones, [&](ForceZoneId, const ForceZone<S>& zone) {
      const Vector half = in_double(zone.half), from_middle = point - in_double(zone.pose.position);
      const Mat3<double> axes = to_matrix(normalise(in_double(zone.pose.orientation)));
      const bool inside = zone.shape == ZoneShape::everywhere ? true
                          : zone.shape == ZoneShape::sphere   ? length(from_middle) <= half.x
                                                              : is_within(transposed_times(axes, from_middle), half);
      if (inside) wind += in_double(zone.wind);
    });
    return wind;
  }

  bool is_under_water(Vector point, Vector& flow) const {
    bool under = false;
    flow = Vector::zero();
    if (up_ == Vector::zero()) return false;
    for_each_record(records_.waters, [&](WaterId, const Water<S>& water) {
      const Vector half = in_double(water.half);
      if (!(half == Vector::zero()) && !is_within(point - in_double(water.middle), half)) return;
      const double height = to_double(water.wave_height), number = kTurn / to_double(water.wave_length),
                   rate = kTurn / to_double(water.wave_period);
      const Vector direction = in_double(water.wave_direction), along = direction - up_ * dot(up_, direction);
      const double phase = number * dot(along, point) - rate * seconds_;
      if (!(dot(up_, point) < to_double(water.surface_height) + height * std::sin(phase))) return;
      under = true;
      flow += in_double(water.current) + (along * std::sin(phase) - up_ * std::cos(phase)) * (height * rate);
    });
    return under;
  }

  const World<S>& world_;
  const RecordStore<S>& records_;
  Vector up_ = Vector::zero();
  double seconds_ = 0;
};

}  // namespace isostep::tool::page
