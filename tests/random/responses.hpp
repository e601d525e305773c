// Random records of how contacts of kinds push, of what slows and of waters by rank: functions of the state and the
// dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/change_record.hpp"
#include "random/dice.hpp"
#include "random/forces.hpp"
#include "random/parts.hpp"
#include "random/zones.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Contacts that move one side alone make no body faster than the fastest; what gives way falls through. All else only
/// takes energy, or lifts what is light by its weight.
template <class S> class RandomResponses {
 public:
  RandomResponses(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  void change() {
    const RecordStore<S>& records = *world_.state().records;
    switch (dice_.below(3)) {
      case 0: return change(records.kind_responses);
      case 1: return change(records.damping_zones);
      default: return change(records.waters);
    }
  }

 private:
  template <class Record, class IdType> void change(const Registry<Record, IdType>& registry) {
    change_record(world_, dice_, registry, [&](const auto& like) { return drawn(like); });
  }
  KindResponse<S> drawn(KindResponse<S> r) {
    r.kind_a = 1 + dice_.below(kMaterialKinds);
    r.kind_b = 1 + dice_.below(kMaterialKinds);
    const double scale = dice_.one_in(3) ? 0 : dice_.in(0.0625, 1);
    const bool on_a = dice_.one_in(2), differ = r.kind_a != r.kind_b;
    if (differ) (on_a ? r.inverse_mass_scale_a : r.inverse_mass_scale_b) = num<S>(scale);
    if (differ) r.inverse_inertia_scale_a = num<S>(dice_.in(0, 1));
    if (dice_.one_in(2)) r.max_force = num<S>(dice_.in(1, 200));
    return r;
  }
  DampingZone<S> drawn(DampingZone<S> zone) {
    ForceZone<S> place;
    draw_zone(dice_, place);
    zone.shape = place.shape;
    zone.pose = place.pose;
    zone.half = place.half;
    zone.linear = num<S>(dice_.in(0, 4));
    zone.angular = num<S>(dice_.one_in(4) ? 16384 : dice_.in(0, 4));
    zone.priority = static_cast<std::int32_t>(dice_.below(5)) - 2;
    zone.replaces = dice_.one_in(2);
    return zone;
  }
  Water<S> drawn(Water<S> water) {
    const BodyId body = RandomForces<S>(world_, dice_).body();
    water.density = num<S>(body ? to_double(world_.mass(body)) * dice_.in(0, 2) : 0);
    water.surface_height = num<S>(dice_.in(-1, 2));
    water.middle = vec<S>(dice_.point(2));
    water.half = vec<S>(dice_.in(1, 3), 4, 2);
    water.linear_drag = num<S>(dice_.in(0, 2));
    water.priority = static_cast<std::int32_t>(dice_.below(5)) - 2;
    water.replaces = dice_.one_in(2);
    return water;
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
