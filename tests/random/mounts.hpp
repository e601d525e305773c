// Random sensors that go with bodies: mounted, moved on their carriers, taken off, destroyed.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "random/dice.hpp"
#include "random/parts.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Mounts at most three of them, balls and boxes, on whatever there is. A function of the state and the dice.
template <class S> class RandomMounts {
 public:
  RandomMounts(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  void change() {
    const auto& mounts = world_.state().records->sensor_mounts;
    const std::vector<SensorMountId> ids = mounts.slot_map().template ids<SensorMountId>();
    if (ids.empty() || (ids.size() < 3 && dice_.one_in(2))) return add();
    const SensorMountId id = dice_.one_of(ids);
    const SensorMount<S> now = *world_.find(id);
    const std::uint32_t what = dice_.below(8);
    if (what == 0) world_.destroy(now.sensor);
    else if (what == 1) world_.destroy(take_off(id));
    else world_.set(id, drawn(now.sensor));
  }

 private:
  BodyId take_off(SensorMountId id) {
    const BodyId sensor = world_.find(id)->sensor;
    world_.remove(id);
    return sensor;
  }
  void add() {
    const double size = dice_.in(0.25, 1);
    BodyDefinition<S> d =
        still<S>(dice_.one_in(2) ? add_ball(world_, size) : add_box(world_, size, 0.5, size), {0, 20, 0});
    d.type = BodyType::kinematic;
    d.sensor = true;
    const SensorMount<S> mount = drawn(world_.create(d));
    if (!world_.add(mount)) world_.destroy(mount.sensor);
  }
  SensorMount<S> drawn(BodyId sensor) {
    SensorMount<S> mount;
    mount.sensor = sensor;
    const std::vector<BodyId> all = world_.bodies();
    mount.on = dice_.one_of(all);
    mount.frame.position = vec<S>(dice_.point(1));
    mount.frame.orientation = dice_.template orientation<S>();
    return mount;
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
