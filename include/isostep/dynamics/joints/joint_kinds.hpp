// The closed set of joints: all that their files say, called by the type that is stored.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

#include "isostep/dynamics/joints/angular.hpp"
#include "isostep/dynamics/joints/ball.hpp"
#include "isostep/dynamics/joints/constant_velocity.hpp"
#include "isostep/dynamics/joints/cylindrical.hpp"
#include "isostep/dynamics/joints/distance.hpp"
#include "isostep/dynamics/joints/fixed.hpp"
#include "isostep/dynamics/joints/hinge.hpp"
#include "isostep/dynamics/joints/planar.hpp"
#include "isostep/dynamics/joints/six_axis.hpp"
#include "isostep/dynamics/joints/slider.hpp"
#include "isostep/dynamics/joints/universal.hpp"

namespace isostep {

/// The members of a joint's file. Its rows are in up to two blocks, of three equalities and two drives.
template <template <class> class Joint, class S>
concept JointOf = requires(JointConstraint<S> joint, const JointConstraint<S> solved, const JointProperties<S> p,
                           const detail::JointFrames<S> frames, Step<S> h, const Pose<S> world) {
  { Joint<S>::kType } -> std::convertible_to<JointType>;
  { Joint<S>::kFlags } -> std::convertible_to<std::uint32_t>;       // those it knows
  { Joint<S>::kFlagNames } -> std::convertible_to<const char*>;     // to whom sets another: "of a hinge kLimit, ..."
  { Joint<S>::kMeasure } -> std::convertible_to<JointMeasure>;      // of its position
  { Joint<S>::kTwoPoints } -> std::convertible_to<bool>;            // origins are apart from the start
  { Joint<S>::kTwistAndSwing } -> std::convertible_to<bool>;        // lower..upper of the twist, cone of the swing
  { Joint<S>::is_point(p) } -> std::same_as<bool>;                  // origins coincide, and the first block is they
  { Joint<S>::is_free(p, 0u) } -> std::same_as<bool>;               // no equality is in that block
  { Joint<S>::fault(p) } -> std::same_as<FaultReport>;              // of finite numbers that every kind would take
  { Joint<S>::count_rows(joint) } -> std::same_as<void>;            // once a step: blocks, drives and what acts on them
  { Joint<S>::linearise(frames, h, joint) } -> std::same_as<void>;  // each sub-step: rows and errors
  { Joint<S>::pull(solved) } -> std::same_as<Vec3<Velocity<S>>>;    // [m/s] world, on b: impulse that stretches arms
  { Joint<S>::error(p, world, world) } -> std::same_as<S>;          // [m] as World::joint_error, of its two frames
};
#define ISO_COMPLETE(name, Joint)                                        \
  static_assert(JointOf<Joint, float>, "a joint's file lacks a member"); \
  static_assert(Joint<float>::kType == JointType::name, "a joint's kType is not its own");
ISO_FOR_EACH_JOINT(ISO_COMPLETE)
#undef ISO_COMPLETE

/// A class of joints, without a scalar.
template <template <class> class Joint> struct JointClass { template <class S> using Of = Joint<S>; };

/// Calls visit(JointClass<BallJoint>{}) for balls, and so on. A world never holds a record of a type outside the list.
template <class Visit> ISO_INLINE constexpr decltype(auto) visit_joint_type(JointType type, Visit&& visit) {
  switch (type) {
#define ISO_CASE(name, Joint) \
  case JointType::name: return visit(JointClass<Joint>{});
    ISO_FOR_EACH_JOINT(ISO_CASE)
#undef ISO_CASE
  }
  ISO_TRAP();
}

ISO_INLINE constexpr JointMeasure measure_of(JointType type) {
  return visit_joint_type(type,
                          [](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<float>::kMeasure; });
}
ISO_INLINE constexpr bool joins_two_points(JointType type) {
  return visit_joint_type(type,
                          [](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<float>::kTwoPoints; });
}
/// Returns true if lower, upper and cone limit the twist about z and the swing of z, and origins coincide.
template <class S> ISO_INLINE constexpr bool bounds_twist_and_swing(JointType type) {
  return visit_joint_type(type,
                          [](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<S>::kTwistAndSwing; });
}
template <class S> ISO_INLINE bool holds_point(const JointProperties<S>& p) {
  return visit_joint_type(p.type,
                          [&](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<S>::is_point(p); });
}
/// Returns true if a block holds no equality: all of its rows are drives or empty.
template <class S> ISO_INLINE bool is_free(const JointProperties<S>& p, std::uint32_t block) {
  return visit_joint_type(
      p.type, [&](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<S>::is_free(p, block); });
}

}  // namespace isostep
