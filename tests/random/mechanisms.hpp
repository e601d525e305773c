// Random couplings of joints and measured joints that may break: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "random/records.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// They add no energy: a coupling holds its sum where it is, or lets it go one way; what is broken only falls.
template <class S> class RandomMechanisms {
 public:
  RandomMechanisms(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  void change() {
    const auto couplings = world_.state().records->couplings.slot_map().template ids<CouplingId>();
    if (dice_.one_in(4)) return measure();
    if (!couplings.empty() && dice_.one_in(2)) {
      const CouplingId id = dice_.one_of(couplings);
      if (dice_.one_in(2)) world_.remove(id);
      else world_.set(id, *world_.find(id));
      return;
    }
    couple();
  }

 private:
  JointId any_joint() {
    const std::vector<JointId> joints = world_.joints();
    return joints.empty() ? JointId{} : dice_.one_of(joints);
  }
  JointId coordinate() {
    for (int tries = 0; tries < 4; ++tries) {
      const JointId id = any_joint();
      if (id && detail::has_coordinate(world_.joint(id)->type)) return id;
    }
    return {};
  }
  S ratio() { return S(static_cast<int>(1 + dice_.below(3)) * (dice_.one_in(2) ? 1 : -1)); }
  void couple() {
    Coupling<S> c;
    c.joint_a = coordinate();
    c.joint_b = coordinate();
    if (!c.joint_a || !c.joint_b) return;
    if (dice_.one_in(3)) c.joint_c = coordinate();
    if (c.joint_c == c.joint_a || c.joint_c == c.joint_b) c.joint_c = {};
    c.ratio_a = ratio();
    c.ratio_b = ratio();
    c.ratio_c = c.joint_c ? ratio() : S(0);
    S sum = c.ratio_a * world_.joint_position(c.joint_a) + c.ratio_b * world_.joint_position(c.joint_b);
    if (c.joint_c) sum += c.ratio_c * world_.joint_position(c.joint_c);
    c.lower = c.upper = sum;
    if (dice_.one_in(3)) c.upper += num<S>(dice_.in(0, 1));
    world_.add(c);
  }
  void measure() {
    if (const auto load = RandomRecords<S>(world_, dice_).template drawn<JointLoad<S>>(); load.joint) world_.add(load);
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
