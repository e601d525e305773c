// Random forces that act from step to step, added to worlds, changed and removed: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/dice.hpp"
#include "random/zones.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Forces of bounded power: they make no body faster than some weights do in some seconds.
template <class S> class RandomForces {
 public:
  RandomForces(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  /// One more, one less, or one that is another now.
  void change() {
    const std::uint32_t kind = dice_.below(drawn_kinds()), what = dice_.below(8);
    std::uint32_t i = 0;
    for_each_drawn([&](const auto& registry) {
      if (i++ == kind) change(registry, what);
    });
  }

  /// A null id where there is no dynamic body.
  BodyId body() {
    const std::vector<BodyId> all = world_.bodies();
    for (int tries = 0; tries < 8; ++tries) {
      const BodyId id = dice_.one_of(all);
      if (world_.type(id) == BodyType::dynamic) return id;
    }
    return {};
  }

 private:
  template <class Record, class IdType> void change(const Registry<Record, IdType>& registry, std::uint32_t what) {
    const std::vector<IdType> ids = registry.slot_map().template ids<IdType>();
    if (ids.empty() || (what < 5 && ids.size() < 6)) {
      Record record;
      if (draw(record)) world_.add(record);
      return;
    }
    const IdType id = dice_.one_of(ids);
    if (what == 5) {
      world_.remove(id);
      return;
    }
    Record record = *world_.find(id);
    if (draw(record)) world_.set(id, record);
  }
  double mass(BodyId id) const { return to_double(world_.mass(id)); }

  // Draws what the records say from now on. False: there is no body for it.
  bool draw(ForceZone<S>& zone) {
    draw_zone(dice_, zone);
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
  bool draw(Explosion<S>& blast) {
    const BodyId id = body();
    if (!id) return false;
    const double weight = mass(id) * 10;
    blast.centre = vec<S>(dice_.point(2) + D3{0, 1, 0});
    blast.begin = world_.tick() + dice_.below(20);
    blast.implosion_force = num<S>(dice_.in(0, 1) * weight);
    blast.implosion_most = num<S>(dice_.in(0, 4));
    blast.implosion_duration = num<S>(dice_.in(0, 0.25));
    blast.wave_force = num<S>(dice_.in(0, 20) * weight);
    blast.wave_speed = num<S>(dice_.in(4, 60));
    blast.wave_width = num<S>(dice_.in(0, 1));
    blast.wave_ramp = num<S>(dice_.in(0, 1));
    blast.wave_duration = num<S>(dice_.in(0, 1));
    blast.chimney_force = num<S>(dice_.in(0, 1) * weight);
    blast.chimney_duration = num<S>(dice_.in(0, 0.5));
    blast.is_shielded = dice_.one_in(2);
    return true;
  }
  bool draw(Water<S>& water) {
    const BodyId id = body();
    if (!id) return false;
    water.surface_height = num<S>(dice_.in(-1, 2));
    water.density = num<S>(mass(id) * dice_.in(0, 2));
    water.middle = vec<S>(dice_.point(2));
    if (dice_.one_in(2)) {
      const double x = dice_.in(1, 4), z = dice_.in(1, 4);
      water.half = vec<S>(x, 8, z);
    }
    water.current = vec<S>(dice_.arrow(0, 2));
    water.linear_drag = num<S>(dice_.in(0, 2));
    water.quadratic_drag = num<S>(dice_.in(0, 1));
    water.angular_drag = num<S>(dice_.in(0, 2));
    water.wave_length = num<S>(dice_.in(4, 20));
    water.wave_height = dice_.one_in(2) ? num<S>(dice_.in(0, 0.25)) : S(0);
    water.wave_period = num<S>(dice_.in(1, 4));
    water.wave_direction = normalise(vec<S>(dice_.arrow(1, 2)));
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
    surface.is_under_water = dice_.one_in(3);
    return true;
  }

  /// Registries of the kinds that are drawn here.
  template <class Visit> void for_each_drawn(const Visit& visit) {
    RecordStore<S>::members(
        [&]<class Record, class IdType>(const char*, const Registry<Record, IdType>& registry) {
          if constexpr (requires(RandomForces & forces, Record & record) { forces.draw(record); }) visit(registry);
        },
        *world_.state().records);
  }
  std::uint32_t drawn_kinds() {
    std::uint32_t kinds = 0;
    for_each_drawn([&](const auto&) { ++kinds; });
    return kinds;
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
