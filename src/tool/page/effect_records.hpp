// The force records of a world, told to a recorder kind by kind: what of each is drawn.
// SPDX-License-Identifier: MIT
#pragma once

#include "effects.hpp"
#include "isostep/particles/particle_world.hpp"
#include "weather.hpp"

namespace isostep::tool::page {

inline std::vector<double> list_of(Vector v) { return {v.x, v.y, v.z}; }

template <class S> Effect effect_of(const Water<S>& water, Vector up) {
  const Vector direction = in_double(water.wave_direction);
  return {"water",
          {{"height", {to_double(water.surface_height)}},
           {"up", list_of(up)},
           {"middle", list_of(in_double(water.middle))},
           {"half", list_of(in_double(water.half))},
           {"wave", {to_double(water.wave_height), to_double(water.wave_length), to_double(water.wave_period)}},
           {"along", list_of(direction - up * dot(up, direction))}}};
}

/// Phases without a force last no time.
template <class S> Effect effect_of(const Explosion<S>& e, Vector up) {
  const auto lasting = [](S force, S duration) { return force == S(0) ? 0.0 : to_double(duration); };
  const bool level = up == Vector::zero();
  return {"explosion",
          {{"centre", list_of(in_double(e.centre))},
           {"begin", {static_cast<double>(e.begin)}},
           {"up", list_of(level ? Vector{0, 1, 0} : up)},
           {"pause", {to_double(e.implosion_duration)}},
           {"implosion", {to_double(e.implosion_most), lasting(e.implosion_force, e.implosion_duration)}},
           {"wave", {to_double(e.wave_speed), to_double(e.wave_width), lasting(e.wave_force, e.wave_duration)}},
           {"chimney",
            {to_double(e.chimney_radius), to_double(e.chimney_height),
             level ? 0.0 : lasting(e.chimney_force, e.chimney_duration)}}}};
}

template <class S> Effect effect_of(const ForceZone<S>& zone) {
  const Quat<double> turn = in_double(zone.pose.orientation);
  return {"zone",
          {{"shape", {static_cast<double>(zone.shape)}},
           {"at", list_of(in_double(zone.pose.position))},
           {"turn", {turn.x, turn.y, turn.z, turn.w}},
           {"half", list_of(in_double(zone.half))},
           {"acceleration", list_of(in_double(zone.acceleration))},
           {"wind", list_of(in_double(zone.wind))}}};
}

template <class S> Effect effect_of(const Thruster<S>& thruster) {
  return {"thruster", {{"point", list_of(in_double(thruster.point))}}};
}

/// [1] The direction in which a tensor resists most: across the plate that it could be of. The eigenvector of the
/// largest eigenvalue of its symmetric part, by power iteration.
inline Vector plate_normal(const Mat3<double>& tensor) {
  Vector normal = {0.48, 0.6, 0.64};
  for (int i = 0; i < 64; ++i) {
    const Vector next = tensor * normal + transposed_times(tensor, normal);
    const double size = length(next);
    if (!(size > 0)) return {0, 1, 0};
    normal = next / size;
  }
  return normal;
}

/// Normals in the body's frame at control -1, 0 and 1.
template <class S> Effect effect_of(const AeroSurface<S>& surface) {
  const Mat3<double> axes = to_matrix(normalise(in_double(surface.orientation)));
  const Mat3<double> none = Mat3<double>::diagonal(Vector::zero());
  const Vector middle = plate_normal(in_double(surface.tensor));
  std::vector<double> normals;
  for (const Mat3<S>* const end : {&surface.low, &surface.tensor, &surface.high}) {
    const Mat3<double> tensor = in_double(*end);
    bool empty = true;
    for (int i = 0; i < 3; ++i) empty = empty && tensor.rows[i] == none.rows[i];
    Vector normal = empty ? middle : plate_normal(tensor);
    if (dot(normal, middle) < 0) normal = -normal;
    for (const double x : list_of(axes * normal)) normals.push_back(x);
  }
  return {"surface",
          {{"point", list_of(in_double(surface.point))},
           {"normals", normals},
           {"wet", {surface.is_under_water ? 1.0 : 0.0}}}};
}

/// Tells a Recorder of one record, of kinds of which a page draws something by themselves.
template <class S, class To> class EffectTeller {
 public:
  EffectTeller(const World<S>& world, To& to) : to_(to), weather_(world) {}

  void tell(ForceZoneId id, const ForceZone<S>& zone) { to_.effect(id.slot, id.generation, {}, effect_of(zone)); }
  void tell(BodySpringId id, const BodySpring<S>& spring) {
    to_.body_spring(id, spring.a, spring.b, in_double(spring.anchor_a), in_double(spring.anchor_b), spring.only_pulls);
  }
  void tell(ThrusterId id, const Thruster<S>& thruster) {
    to_.effect(id.slot, id.generation, thruster.body, effect_of(thruster));
    to_.push(weather_.force_of(thruster), 0);
  }
  void tell(ExplosionId id, const Explosion<S>& explosion) {
    to_.effect(id.slot, id.generation, {}, effect_of(explosion, weather_.up()));
  }
  void tell(WaterId id, const Water<S>& water) {
    const Vector up = weather_.up();
    if (!(up == Vector::zero())) to_.effect(id.slot, id.generation, {}, effect_of(water, up));
  }
  void tell(AeroSurfaceId id, const AeroSurface<S>& surface) {
    to_.effect(id.slot, id.generation, surface.body, effect_of(surface));
    to_.push(weather_.force_of(surface), to_double(surface.control));
  }

  // The others show only in what bodies do, or DebugDraw draws them.
  template <class Id, class Record> void tell(Id, const Record&) {}

 private:
  To& to_;
  const Weather<S> weather_;
};

/// `to` is a Recorder. In the order of the list of records.
template <class S, class To> void record_effects(const World<S>& world, To& to) {
  const RecordStore<S>& records = *world.state().records;
  if (records.kinds() == 0) return;
  EffectTeller<S, To> teller(world, to);
  RecordStore<S>::members(
      [&](const char*, const auto& registry) {
        for_each_record(registry, [&](const auto id, const auto& record) { teller.tell(id, record); });
      },
      records);
}
/// Their springs and links are drawn as bonds.
template <class S, class To> void record_effects(const ParticleWorld<S>&, To&) {}

}  // namespace isostep::tool::page
