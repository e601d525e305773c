// A random tree of joints is watched for ten seconds: its energy against what it was given, how far its joints come
// apart and pass their limits, and what free fall does to its momentum.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "random/driven_axis.hpp"
#include "random/joint_hold.hpp"
#include "random/joint_tree.hpp"

namespace isostep::test {

/// The worst of a run.
struct JointTreeFindings {
  bool made = false;  // a scalar of small range refuses some arms
  double energy = 0;  // [1] above what it may have, of all that ever moved it
  double place = 0;   // [m] off what a joint locks
  double angle = 0;   // [rad] the same
  double past = 0;    // [m] or [rad] beyond a hard limit
  double drift = 0;   // [m/s] of the centre of mass of what floats
  int faults = 0;     // steps that had to mend something
  int unsolved = 0;   // steps that left an island less exact

  void operator+=(const JointTreeFindings& o) {
    energy = std::max(energy, o.energy);
    place = std::max(place, o.place);
    angle = std::max(angle, o.angle);
    past = std::max(past, o.past);
    drift = std::max(drift, o.drift);
    faults += o.faults;
    unsolved += o.unsolved;
  }
};

template <class S> class JointTreeWatch {
 public:
  explicit JointTreeWatch(const RandomJointTree<S>& tree) : tree_(tree) {
    const World<S>& w = tree.world;
    for (const JointId id : tree.joints) {
      joints_.push_back({id, false});
      if (w.joint(id)->type != JointType::six_axis) axes_.push_back(DrivenAxis::of(w, id));
    }
    for (const AxisDrive<S>& drive : w.state().records->axis_drives.all()) axes_.push_back(DrivenAxis::of(w, drive));
    start_ = momentum();
    for (const BodyId id : tree.bodies) {
      mass_ += to_double(w.mass(id));
      moved_by_ += kinetic_energy(w.view(id));
    }
    moved_by_ += mass_ * (tree.hangs ? tree.gravity() * tree.reach : 0.0) + mass_ * kCreep * kCreep / 2;
    allowed_ = energy();
    for (const DrivenAxis& axis : axes_) {
      stores_ = stores_ || axis.stores();
      give(axis.held());
    }
    found_.made = true;
  }

  void see(const StepReport& report) {
    ++frame_;
    found_.faults += report.clean() ? 0 : 1;
    found_.unsolved += report.unsolved != 0 ? 1 : 0;
    for (DrivenAxis& axis : axes_) give(axis.work(tree_.world));
    see_energy();
    for (Joint& joint : joints_) see_joint(joint);
    if (tree_.hangs) return;
    const D3 fallen = {0, -tree_.gravity() * frame_ / 60, 0};
    worst(found_.drift, length((momentum() - start_) * (1 / mass_) - fallen));
  }
  const JointTreeFindings& findings() const { return found_; }

 private:
  static constexpr double kCreep = 0.1;  // [m/s] what rounding and a sub-step of gravity make of a body at rest

  struct Joint {
    JointId id;
    bool folded;  // a twist alone is locked, and it was lost
  };

  static void worst(double& most, double now) { most = std::isfinite(now) ? std::max(most, now) : 1e30; }
  void give(double energy) {
    allowed_ += energy;
    moved_by_ += energy;
  }
  /// A tree that stores nothing only loses: what it has lost it may not have back.
  void see_energy() {
    const double excess = energy() - allowed_;
    least_ = stores_ ? 0.0 : std::min(least_, excess);
    worst(found_.energy, (excess - least_) / moved_by_);
  }
  void see_joint(Joint& joint) {
    const World<S>& w = tree_.world;
    const JointHold hold = hold_of(w, joint.id);
    worst(found_.place, hold.place);
    joint.folded = joint.folded || (locks_twist_alone(*w.joint(joint.id)) && kTwistEnds < hold.swing);
    if (!joint.folded) worst(found_.angle, hold.angle);
    const JointProperties<S>& p = *w.joint(joint.id);
    const bool cone = (p.flags & joint_flag::kCone) != 0 && p.type != JointType::six_axis;
    if (cone) worst(found_.past, hold.swing - to_double(p.cone));
    for (DrivenAxis& axis : axes_)
      if (axis.joint() == joint.id) worst(found_.past, axis.past(hold.swing));
  }

  D3 momentum() const {
    D3 sum = {0, 0, 0};
    for (const BodyId id : tree_.bodies) sum += real(tree_.world.velocity(id)) * to_double(tree_.world.mass(id));
    return sum;
  }
  /// [J] The energy of motion and height; of what floats, as seen by its centre of mass.
  double energy() const {
    const World<S>& w = tree_.world;
    double sum = 0;
    for (const BodyId id : tree_.bodies) {
      const BodyView<S> body = w.view(id);
      sum += kinetic_energy(body);
      if (tree_.hangs) sum += to_double(w.mass(id)) * tree_.gravity() * to_double(body.state->centre.y);
    }
    if (tree_.hangs) return sum;
    const D3 p = momentum();
    return sum - dot(p, p) / mass_ / 2;
  }

  const RandomJointTree<S>& tree_;
  std::vector<Joint> joints_;
  std::vector<DrivenAxis> axes_;
  D3 start_ = {0, 0, 0};                           // [kg m/s]
  double mass_ = 0;                                // [kg]
  double allowed_ = 0, moved_by_ = 0, least_ = 0;  // [J]
  bool stores_ = false;
  int frame_ = 0;
  JointTreeFindings found_;
};

template <class S> JointTreeFindings try_joint_tree(std::uint64_t seed, const JointTreeTrial& trial, int frames = 600) {
  RandomJointTree<S> tree(seed, trial);
  if (!tree.made()) return {};
  JointTreeWatch<S> watch(tree);
  for (int frame = 0; frame < frames; ++frame) watch.see(tree.world.step());
  return watch.findings();
}

}  // namespace isostep::test
