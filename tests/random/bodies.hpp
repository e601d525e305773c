// Random changes of what bodies are and where they are to be: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Movers stay as slow as they are, and joints hold: what they tie stays what it is.
template <class S> class RandomBodies {
 public:
  RandomBodies(World<S>& world, Dice& dice, double most_speed) : world_(world), dice_(dice), most_speed_(most_speed) {}

  void change() {
    switch (dice_.below(6)) {
      case 0:
      case 1: return disable_or_enable();
      case 2: return change_type();
      case 3: return change_mass();
      case 4: world_.sleep(any_body()); return;
      default: return move();
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

  World<S>& world_;
  Dice& dice_;
  double most_speed_;  // [m/s]
};

}  // namespace isostep::test
