// Random changes of what bodies are and where they are to be, of kinds that pass each other and of zones that hide
// others: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/change_record.hpp"
#include "random/dice.hpp"
#include "random/parts.hpp"
#include "random/zones.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Movers stay as slow as they are, and joints hold: what they tie stays what it is.
template <class S> class RandomBodies {
 public:
  RandomBodies(World<S>& world, Dice& dice, double most_speed) : world_(world), dice_(dice), most_speed_(most_speed) {}

  void change() {
    switch (dice_.below(8)) {
      case 0:
      case 1: return disable_or_enable();
      case 2: return change_type();
      case 3: return change_mass();
      case 4: world_.sleep(any_body()); return;
      case 5: return move();
      case 6: return change(world_.state().records->kind_ghosts);
      default: return change(world_.state().records->force_zones);
    }
  }

 private:
  BodyId any_body() {
    const std::vector<BodyId> all = world_.bodies();
    return dice_.one_of(all);
  }
  bool has_joints(BodyId id) const {
    for (const JointId joint : world_.joints()) {
      const JointProperties<S>& p = *world_.joint(joint);
      if (p.body_a == id.slot || p.body_b == id.slot) return true;
    }
    return false;
  }
  /// The body is not the ground, through which others would fall, and has no joints.
  bool is_loose(BodyId id) const {
    const D3 size = real(world_.view(id).state->fat.high - world_.view(id).state->fat.low);
    return size.x < 8 && size.z < 8 && !has_joints(id);
  }
  void disable_or_enable() {
    for (const BodyId id : world_.bodies()) {
      if (world_.is_enabled(id) || !dice_.one_in(2)) continue;
      world_.set_enabled(id, true);
      return;
    }
    const BodyId id = any_body();
    if (is_loose(id)) world_.set_enabled(id, false);
  }
  void change_type() {
    const BodyId id = any_body();
    if (!is_loose(id)) return;
    BodyMass<S> mass;
    if (dice_.one_in(2)) mass.mass = num<S>(dice_.in(0.5, 8));
    world_.set_type(id, world_.type(id) == dynamic ? BodyType::static_ : dynamic, mass);
  }
  void change_mass() {
    const BodyId id = any_body();
    BodyMass<S> mass;
    mass.mass = num<S>(to_double(world_.mass(id)) * dice_.in(0.5, 2));
    if (world_.type(id) == dynamic) world_.set_mass(id, mass);
  }
  void move() {
    const BodyId id = any_body();
    if (world_.type(id) != kinematic) return;
    Pose<S> pose = world_.pose(id);
    const double way = most_speed_ / world_.settings().hz;
    pose.position = pose.position + vec<S>(dice_.arrow(0, way));
    pose.orientation = turn<S>({0, 1, 0}, dice_.in(-way / 4, way / 4)) * pose.orientation;
    world_.move_to(id, pose);
  }

  template <class Record, class IdType> void change(const Registry<Record, IdType>& registry) {
    change_record(world_, dice_, registry, [&](const auto& like) { return drawn(like); });
  }
  KindGhost<S> drawn(KindGhost<S> ghost) {
    ghost.kind_a = 1 + dice_.below(kMaterialKinds);
    ghost.kind_b = 1 + dice_.below(kMaterialKinds);
    return ghost;
  }
  ForceZone<S> drawn(ForceZone<S> zone) {
    draw_zone(dice_, zone);
    zone.priority = static_cast<std::int32_t>(dice_.below(5)) - 2;
    zone.replaces = dice_.below(zone_effect::kAll + 1);
    return zone;
  }

  World<S>& world_;
  Dice& dice_;
  double most_speed_;  // [m/s]
};

}  // namespace isostep::test
