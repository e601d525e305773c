// Bodies of ragdoll.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/effects/ragdoll.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {

namespace detail {

template <class S> class RagdollBuilder {
 public:
  RagdollBuilder(World<S>& world, std::span<const RagdollBone<S>> bones, const RagdollSettings<S>& settings)
      : world_(world), bones_(bones), settings_(settings) {}

  /// Returns false if a setting or a bone was refused.
  bool build() {
    const FaultReport fault = fault_of_plan();
    if (fault != Fault::none) return world_.refuse("add_ragdoll", fault);
    for (const RagdollBone<S>& bone : bones_) {
      if (!add_body(bone)) return false;
    }
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      if (!add_joint(i)) return false;
    }
    part_overlaps();
    return true;
  }
  Ragdoll<S> take() { return static_cast<Ragdoll<S>&&>(made_); }
  /// Destroys the bodies made so far. Their joints end with them.
  void take_back() {
    for (const BodyId body : made_.bodies) world_.destroy(body);
  }

 private:
  /// Checks what the world is not asked.
  FaultReport fault_of_plan() const {
    const S friction = settings_.friction, force = settings_.pose.max_force;
    Checklist list;
    list.finite(friction, "friction")
        .finite(force, "pose.max_force")
        .proper(S(0) <= friction, "friction", "0 or more")
        .proper(S(0) <= force, "pose.max_force", "0 or more")
        .proper(friction == S(0) || force == S(0), "friction", "0 where servos hold the pose")
        .proper(settings_.pose.target == S(0), "pose.target", "0: that of every axis at rest")
        .proper(settings_.pose.mass == S(0), "pose.mass", "0: what hangs on each joint at rest")
        .proper(force == S(0) || S(0) < settings_.pose.frequency, "pose.frequency", "above 0 where pose.max_force is");
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      const int parent = bones_[i].parent;
      list.proper(parent == -1 || (0 <= parent && static_cast<std::size_t>(parent) < i), "parent",
                  "-1, or the index of an earlier bone");
    }
    return list.report();
  }
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
  bool add_joint(std::size_t index) {
    const RagdollBone<S>& bone = bones_[index];
    if (bone.parent < 0) {
      made_.joints.push_back({});
      return true;
    }
    JointDefinition<S> joint = definition_of(bone);
    joint.a = made_.bodies[static_cast<std::size_t>(bone.parent)];
    joint.b = made_.bodies[index];
    for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
      AxisDrive<S>& drive = joint.drives[i];
      const int axis = static_cast<int>(drive.axis) - static_cast<int>(JointAxis::swing_x);
      drive.spring_mass = inertia_behind(index, to_matrix(bone.joint.orientation).column(axis));
    }
    joint.frame_a = joint.frame_b = bone.joint;
    made_.joints.push_back(world_.create(joint));
    return static_cast<bool>(made_.joints.back());
  }
  /// [kg m^2] Returns the inertia of the bone and all that hangs on it, about an axis through its joint; at most
  /// Limits<S>::mass().
  S inertia_behind(std::size_t index, Vec3<Unit<S>> axis) const {
    S sum = S(0);
    std::vector<bool> behind(bones_.size(), false);
    for (std::size_t i = index; i < bones_.size(); ++i) {
      const int parent = bones_[i].parent;
      behind[i] = i == index || (parent >= 0 && behind[static_cast<std::size_t>(parent)]);
      if (!behind[i]) continue;
      const BodyId body = made_.bodies[i];
      const Vec3<S> lever = cross(world_.center_of_mass(body) - bones_[index].joint.position, convert<S>(axis));
      const S about_joint = saturate_to<S>(product(world_.mass(body), dot(lever, lever)));
      sum = saturating_add(sum, saturating_add(world_.inertia(body, axis), about_joint));
    }
    return min(sum, Limits<S>::mass());
  }
  JointDefinition<S> definition_of(const RagdollBone<S>& bone) const {
    const bool acts = S(0) < settings_.friction || S(0) < settings_.pose.max_force || S(0) < settings_.limit_frequency;
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
    drive.max_force = settings_.friction;
    drive.limit_frequency = settings_.limit_frequency;
    drive.limit_damping = settings_.limit_damping;
    if (S(0) < settings_.pose.max_force) {
      drive.max_force = settings_.pose.max_force;
      drive.spring_frequency = settings_.pose.frequency;
      drive.spring_damping = settings_.pose.damping;
    } else {
      drive.motor = S(0) < settings_.friction;
    }
    return drive;
  }
  /// Adds a Ghost for bodies that overlap at rest: otherwise contacts would push them against their joints.
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
  return pin_floats([&]() -> Ragdoll<S> {
    detail::RagdollBuilder<S> builder(world, bones, settings);
    if (builder.build()) return builder.take();
    builder.take_back();
    return {};
  });
}

}  // namespace isostep
