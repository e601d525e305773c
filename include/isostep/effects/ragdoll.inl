// Bodies of ragdoll.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/effects/ragdoll.hpp"

namespace isostep {

namespace detail {

template <class S> class RagdollBuilder {
 public:
  RagdollBuilder(World<S>& world, std::span<const RagdollBone<S>> bones, const RagdollSettings<S>& settings)
      : world_(world), bones_(bones), settings_(settings) {}

  /// False: a bone was refused.
  bool build() {
    for (const RagdollBone<S>& bone : bones_) {
      if (!add_body(bone) || !add_joint(bone)) return false;
    }
    part_overlaps();
    return true;
  }
  Ragdoll<S> take() { return static_cast<Ragdoll<S>&&>(made_); }
  /// Their joints end with them.
  void take_back() {
    for (const BodyId body : made_.bodies) world_.destroy(body);
  }

 private:
  bool add_body(const RagdollBone<S>& bone) {
    BodyDefinition<S> body;
    body.type = BodyType::dynamic;
    body.shape = bone.shape;
    body.position = bone.pose.position;
    body.orientation = bone.pose.orientation;
    body.mass = bone.mass;
    body.material = settings_.material;
    body.filter = settings_.filter;
    const BodyId id = world_.create(body);
    if (id) made_.bodies.push_back(id);
    return static_cast<bool>(id);
  }
  bool add_joint(const RagdollBone<S>& bone) {
    const std::size_t parents = made_.bodies.size() - 1;
    if (bone.parent < 0 || parents <= static_cast<std::size_t>(bone.parent)) {
      made_.joints.push_back({});
      return true;
    }
    JointDefinition<S> joint = definition_of(bone);
    joint.a = made_.bodies[static_cast<std::size_t>(bone.parent)];
    joint.b = made_.bodies.back();
    joint.frame_a = joint.frame_b = bone.joint;
    made_.joints.push_back(world_.create(joint));
    return static_cast<bool>(made_.joints.back());
  }
  JointDefinition<S> definition_of(const RagdollBone<S>& bone) const {
    const bool acts = S(0) < settings_.friction || S(0) < settings_.pose.force;
    const bool round = bone.swing_x == bone.swing_y;
    if (!acts && bone.hinge) return hinge<S>({.limit = JointRange<S>{bone.lower, bone.upper}});
    if (!acts && round) return ball<S>({.cone = bone.swing_x, .twist = JointRange<S>{bone.lower, bone.upper}});
    SixAxisDefinition<S> joint;
    joint.locks = joint_flag::kLockPoint | (bone.hinge ? joint_flag::kLockSwing : joint_flag::kCone);
    if (!bone.hinge) {
      joint.drives[joint.drive_count++] = drive_of(JointAxis::swing_x, -bone.swing_x, bone.swing_x);
      joint.drives[joint.drive_count++] = drive_of(JointAxis::swing_y, -bone.swing_y, bone.swing_y);
    }
    joint.drives[joint.drive_count++] = drive_of(JointAxis::twist, bone.lower, bone.upper);
    return six_axis(joint);
  }
  AxisDrive<S> drive_of(JointAxis axis, S lower, S upper) const {
    AxisDrive<S> drive;
    drive.axis = axis;
    drive.limited = true;
    drive.lower = lower;
    drive.upper = upper;
    drive.force = settings_.friction;
    if (S(0) < settings_.pose.force) {
      drive.force = settings_.pose.force;
      drive.spring_frequency = settings_.pose.frequency;
      drive.spring_damping = settings_.pose.damping;
      drive.spring_target = settings_.pose.target;
    } else {
      drive.motor = S(0) < settings_.friction;
    }
    return drive;
  }
  /// What overlaps where it rests would be pushed against what its joints hold.
  void part_overlaps() {
    std::vector<BodyId> there;
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      there.clear();
      world_.overlap_shape(bones_[i].shape, bones_[i].pose, there);
      for (std::size_t k = i + 1; k < bones_.size(); ++k) {
        if (bones_[k].parent == static_cast<int>(i)) continue;
        bool overlaps = false;
        for (const BodyId other : there) overlaps = overlaps || other == made_.bodies[k];
        if (overlaps) world_.add(Ghost<S>{made_.bodies[i], made_.bodies[k]});
      }
    }
  }

  World<S>& world_;
  std::span<const RagdollBone<S>> bones_;
  const RagdollSettings<S>& settings_;
  Ragdoll<S> made_;
};

}  // namespace detail

template <class S>
Ragdoll<S> add_ragdoll(World<S>& world, std::span<const RagdollBone<S>> bones, const RagdollSettings<S>& settings) {
  detail::RagdollBuilder<S> builder(world, bones, settings);
  if (builder.build()) return builder.take();
  builder.take_back();
  return {};
}

}  // namespace isostep
