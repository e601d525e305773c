// The closed list of commands: every way in which a game changes a world between steps.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iterator>
#include <variant>
#include <vector>

#include "isostep/core/id.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/world/definitions.hpp"

namespace isostep {

inline constexpr std::uint32_t kMaxChildren = 1u << 16;  // parts of one shape

template <class S> struct AddShape {
  std::vector<Child<S>> children;

  ISO_INLINE void write(Writer& writer) const { writer.write_array(children); }
  ISO_INLINE void read(Reader& reader) { reader.read_array(children, kMaxChildren); }
};
struct RemoveShape {
  ShapeId shape;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("shape", self.shape);
  }
};
template <class S> struct CreateBody {
  BodyDefinition<S> definition;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("definition", self.definition);
  }
};
struct DestroyBody {
  BodyId body;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
  }
};
struct WakeBody {
  BodyId body;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
  }
};
/// Teleports; velocity stays.
template <class S> struct SetPose {
  BodyId body;
  Pose<S> pose;  // of the body's origin
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("pose", self.pose);
  }
};
template <class S> struct SetVelocity {
  BodyId body;
  Vec3<S> linear;   // [m/s] of the centre of mass
  Vec3<S> angular;  // [rad/s] world
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
};
/// Acts over the next step.
template <class S> struct ApplyForce {
  BodyId body;
  Vec3<S> force;   // [N] at the centre of mass
  Vec3<S> torque;  // [N m]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("force", self.force);
    visit("torque", self.torque);
  }
};
/// Acts at once.
template <class S> struct ApplyImpulse {
  BodyId body;
  Vec3<S> linear;   // [kg m/s] at the centre of mass
  Vec3<S> angular;  // [kg m^2/s]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
};
template <class S> struct SetMaterial {
  BodyId body;
  Material<S> material;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("material", self.material);
  }
};
struct SetFilter {
  BodyId body;
  Filter filter;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("filter", self.filter);
  }
};
/// How gravity and damping act on a body, and which motions are locked.
template <class S> struct SetMotion {
  BodyId body;
  S gravity_scale;      // [1]
  S linear_damping;     // [1/s]
  S angular_damping;    // [1/s]
  std::uint32_t locks;  // body_flag::kLockX ...
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("gravity_scale", self.gravity_scale);
    visit("linear_damping", self.linear_damping);
    visit("angular_damping", self.angular_damping);
    visit("locks", self.locks);
  }
};
struct SetUserData {
  BodyId body;
  std::uint64_t user_data;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("user_data", self.user_data);
  }
};
template <class S> struct SetGravity {
  Vec3<S> gravity;  // [m/s^2]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("gravity", self.gravity);
  }
};
template <class S> struct CreateJoint {
  JointProperties<S> joint;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("joint", self.joint);
  }
};
struct DestroyJoint {
  JointId joint;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("joint", self.joint);
  }
};
/// Limits, motor and spring of a joint that exists; bodies, frames and type stay.
template <class S> struct SetJoint {
  JointId joint;
  JointProperties<S> properties;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("joint", self.joint);
    visit("properties", self.properties);
  }
};

/// The position in this list is the command's number in replays: append, never reorder.
template <class S>
using Command = std::variant<AddShape<S>, RemoveShape, CreateBody<S>, DestroyBody, WakeBody, SetPose<S>, SetVelocity<S>,
                             ApplyForce<S>, ApplyImpulse<S>, SetMaterial<S>, SetFilter, SetMotion<S>, SetUserData,
                             SetGravity<S>, CreateJoint<S>, DestroyJoint, SetJoint<S>>;

/// By that number.
inline constexpr const char* kCommandNames[] = {
    "add_shape",     "remove_shape", "create_body",   "destroy_body",  "wake_body",  "set_pose",
    "set_velocity",  "apply_force",  "apply_impulse", "set_material",  "set_filter", "set_motion",
    "set_user_data", "set_gravity",  "create_joint",  "destroy_joint", "set_joint"};
static_assert(std::size(kCommandNames) == std::variant_size_v<Command<float>>);

}  // namespace isostep
