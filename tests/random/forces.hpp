// Random forces that act from step to step, added to worlds, changed and removed: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Of bounded power: no faster than some weights for some seconds make a body.
template <class S> class RandomForces {
 public:
  RandomForces(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  /// One more, one less, or one that is another now.
  void change() {
    const std::uint32_t kind = dice_.below(7), what = dice_.below(8);
    std::uint32_t i = 0;
    ForceRecords<S>::members(
        [&](const char*, const auto& registry) {
          if (i++ == kind) change(registry, what);
        },
        *world_.state().force_records);
  }

 private:
  template <class Record, class IdType> void change(const Registry<Record, IdType>& registry, std::uint32_t what) {
    const std::vector<IdType> ids = registry.slots().template ids<IdType>();
    if (ids.empty() || (what < 5 && ids.size() < 6)) {
      Record record;
      if (draw(record)) world_.add(record);
      return;
    }
    const IdType id = ids[dice_.below(static_cast<std::uint32_t>(ids.size()))];
    if (what == 5) {
      world_.remove(id);
      return;
    }
    Record record = *world_.find(id);
    if (draw(record)) world_.set(id, record);
  }
  /// A null id where there is no dynamic body.
  BodyId body() {
    const std::vector<BodyId> all = world_.bodies();
    for (int tries = 0; tries < 8; ++tries) {
      const BodyId id = all[dice_.below(static_cast<std::uint32_t>(all.size()))];
      if (world_.type(id) == BodyType::dynamic) return id;
    }
    return {};
  }
  double mass(BodyId id) const { return to_double(world_.mass(id)); }

  // What the records say from now on. False: there is no body for it.
  bool draw(ForceZone<S>& zone) {
    zone.shape = static_cast<ZoneShape>(dice_.below(3));
    zone.pose.position = vec<S>(dice_.point(3));
    zone.pose.orientation = dice_.template orientation<S>();
    const double x = dice_.in(0.5, 2), y = dice_.in(0.5, 2);
    zone.half = vec<S>(x, y, dice_.in(0.5, 2));
    zone.acceleration = vec<S>(dice_.arrow(0, 3));
    zone.wind = vec<S>(dice_.arrow(0, 3));
    return true;
  }
  bool draw(Attractor<S>& attractor) {
    if (dice_.one_in(2)) attractor.body = body();
    attractor.point = vec<S>(dice_.point(3) + D3{0, 2, 0});
    attractor.strength = num<S>(dice_.in(-2, 4));
    attractor.range = num<S>(dice_.in(1, 4));
    return true;
  }
  bool draw(BodySpring<S>& spring) {
    spring.a = body();
    spring.b = dice_.one_in(3) ? BodyId{} : body();
    if (!spring.a || spring.a == spring.b) return false;
    const Pose<S> at = world_.pose(spring.a);
    spring.anchor_a = vec<S>(dice_.point(0.0625));
    spring.anchor_b = spring.b ? vec<S>(dice_.point(0.0625)) : at.position + vec<S>(dice_.arrow(0.5, 1));
    const double m = spring.b ? std::min(mass(spring.a), mass(spring.b)) : mass(spring.a);
    spring.rest_length = num<S>(dice_.in(0.5, 2));
    spring.stiffness = num<S>(dice_.in(0, 40) * m);
    spring.damping = num<S>(dice_.in(0, 2) * m);
    spring.only_pulls = dice_.one_in(2);
    return true;
  }
  bool draw(Thruster<S>& thruster) {
    thruster.body = body();
    if (!thruster.body) return false;
    thruster.point = vec<S>(dice_.point(0.0625));
    thruster.force = vec<S>(dice_.arrow_of(dice_.in(0, 4) * mass(thruster.body)));
    return true;
  }
  bool draw(BuoyancyPoint<S>& buoyancy) {
    buoyancy.body = body();
    if (!buoyancy.body) return false;
    buoyancy.max_depth = num<S>(dice_.in(0.125, 0.5));
    buoyancy.volume = num<S>(dice_.in(0, 2));
    buoyancy.density = num<S>(mass(buoyancy.body));
    buoyancy.surface_height = num<S>(dice_.in(0, 2));
    return true;
  }
  bool draw(BodyDrag<S>& drag) {
    drag.body = body();
    if (!drag.body) return false;
    const double m = mass(drag.body), stiff = dice_.one_in(4) ? 100 : 1;
    drag.linear = num<S>(dice_.in(0, 2) * m * stiff);
    drag.quadratic = num<S>(dice_.in(0, 1) * m * stiff);
    drag.angular = num<S>(dice_.in(0, 0.25) * m * stiff);
    return true;
  }
  bool draw(AeroSurface<S>& surface) {
    surface.body = body();
    if (!surface.body) return false;
    const double m = mass(surface.body), stiff = dice_.one_in(4) ? 100 : 1;
    surface.point = vec<S>(dice_.point(0.0625));
    surface.orientation = dice_.template orientation<S>();
    for (Mat3<S>* tensor : {&surface.tensor, &surface.low, &surface.high}) {
      const double x = dice_.in(-2, 0), y = dice_.in(-2, 0);
      *tensor = Mat3<S>::diagonal(vec<S>(D3{x, y, dice_.in(-2, 0)} * (m * stiff)));
    }
    surface.control = num<S>(dice_.in(-1, 1));
    surface.is_quadratic = dice_.one_in(2);
    return true;
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
