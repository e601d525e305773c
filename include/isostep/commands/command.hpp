// The closed list of commands: every way in which a game changes a world between steps.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/records/record_store.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/command_log.hpp"
#include "isostep/state/record_commands.hpp"
#include "isostep/store/definitions.hpp"

namespace isostep {

template <class S> struct AddShape {
  std::vector<Child<S>> children;
  std::vector<BlobMention> blobs = {};  // 1 + the index here is Primitive::blob of the children that name it

  ISO_INLINE void write(Writer& writer) const {
    writer.write_array(children);
    for (const BlobMention& blob : blobs) blob.write(writer);
  }
  /// Reads as many blobs as the children name.
  ISO_INLINE void read(Reader& reader) {
    reader.read_array(children, kMaxChildren);
    std::uint32_t count = 0;
    for (const Child<S>& child : children) count = max(count, child.primitive.blob);
    if (count > children.size()) reader.fail(ErrorCode::invalid, "a shape names more blobs than it has parts");
    blobs.resize(reader.ok() ? count : 0);
    for (BlobMention& blob : blobs) blob.read(reader);
  }
};
struct RemoveShape {
  ShapeId shape;
  ISO_FIELDS(shape)
};
template <class S> struct CreateBody {
  BodyDefinition<S> definition;
  ISO_FIELDS(definition)
};
struct DestroyBody {
  BodyId body;
  ISO_FIELDS(body)
};
struct WakeBody {
  BodyId body;
  ISO_FIELDS(body)
};
/// Places the body elsewhere at once; its velocity stays.
template <class S> struct SetPose {
  BodyId body;
  Pose<S> pose;  // of the body's origin
  ISO_FIELDS(body, pose)
};
template <class S> struct SetVelocity {
  BodyId body;
  Vec3<S> linear;   // [m/s] of the centre of mass
  Vec3<S> angular;  // [rad/s] world
  ISO_FIELDS(body, linear, angular)
};
/// The force acts over the next step.
template <class S> struct ApplyForce {
  BodyId body;
  Vec3<S> force;   // [N] at the centre of mass
  Vec3<S> torque;  // [N m]
  ISO_FIELDS(body, force, torque)
};
/// The impulse acts at once.
template <class S> struct ApplyImpulse {
  BodyId body;
  Vec3<S> linear;   // [kg m/s] at the centre of mass
  Vec3<S> angular;  // [kg m^2/s]
  ISO_FIELDS(body, linear, angular)
};
template <class S> struct SetMaterial {
  BodyId body;
  Material<S> material;
  ISO_FIELDS(body, material)
};
struct SetFilter {
  BodyId body;
  Filter filter;
  ISO_FIELDS(body, filter)
};
/// Sets the factors by which gravity and damping act on a body, and its locks; locked motions stop.
template <class S> struct SetMotion {
  BodyId body;
  S gravity_scale;      // [1]
  S linear_damping;     // [1/s]
  S angular_damping;    // [1/s]
  std::uint32_t locks;  // body_flag::kLockX ...
  ISO_FIELDS(body, gravity_scale, linear_damping, angular_damping, locks)
};
struct SetUserData {
  BodyId body;
  std::uint64_t user_data;
  ISO_FIELDS(body, user_data)
};
template <class S> struct SetGravity {
  Vec3<S> gravity;  // [m/s^2]
  ISO_FIELDS(gravity)
};
template <class S> struct CreateJoint {
  JointProperties<S> joint;
  ISO_FIELDS(joint)
};
struct DestroyJoint {
  JointId joint;
  ISO_FIELDS(joint)
};
/// Changes limits, motor and spring of a joint; bodies, frames and type stay.
template <class S> struct SetJoint {
  JointId joint;
  JointProperties<S> properties;
  ISO_FIELDS(joint, properties)
};

/// Keeps the joint's position within lower..upper.
template <class S> struct SetJointLimits {
  JointId joint;
  S lower, upper;  // [rad], [m] of a length
  ISO_FIELDS(joint, lower, upper)
};
/// A motor drives the joint at this speed with at most this force or torque.
template <class S> struct SetJointMotor {
  JointId joint;
  S speed;      // [rad/s], [m/s] along a length
  S max_force;  // [N m], [N] along a length; 0: no motor
  ISO_FIELDS(joint, speed, max_force)
};
/// A spring pulls the joint to its target.
template <class S> struct SetJointSpring {
  JointId joint;
  S frequency;  // [Hz] 0: no spring
  S damping;    // [1] ratio, 1 = critical
  ISO_FIELDS(joint, frequency, damping)
};
/// Sets the target to which the joint's spring pulls.
template <class S> struct SetJointTarget {
  JointId joint;
  S target;  // [rad], [m] of a length
  ISO_FIELDS(joint, target)
};

/// Sets how fast a wheel turns from now on: for a car that is put on the road at speed, or starts anew.
template <class S> struct SetWheelSpin {
  WheelId wheel;
  S spin;  // [rad/s]
  ISO_FIELDS(wheel, spin)
};

/// Gives a rectangle of a height field other heights and materials: HeightPatch as a record. The shape's field becomes
/// another one, with a name of its own, for all bodies of the shape. Bodies nearby wake, and buried ones rise.
struct SetHeights {
  static constexpr std::uint32_t kMost = 1u << 26;  // heights in a file; fields have fewer places

  ShapeId shape;
  std::uint32_t child;  // of the shape: a height field
  std::uint32_t column, row, columns, rows;
  std::vector<std::int16_t> heights;
  std::vector<std::uint8_t> materials = {};

  ISO_INLINE HeightPatch patch() const { return {column, row, columns, rows, heights, materials}; }
  ISO_INLINE void write(Writer& writer) const {
    writer.write(shape);
    for (const std::uint32_t number : {child, column, row, columns, rows}) writer.write(number);
    writer.write_array(heights);
    writer.write_bytes(materials);
  }
  ISO_INLINE void read(Reader& reader) {
    reader.read(shape);
    for (std::uint32_t* const number : {&child, &column, &row, &columns, &rows}) reader.read(*number);
    reader.read_array(heights, kMost);
    const Bytes bytes = reader.read_bytes(kMost);
    materials.assign(bytes.begin(), bytes.end());
  }
};

/// A disabled body keeps its id, state, joints and records. It takes no part until it is enabled again: see
/// World::set_enabled.
struct SetEnabled {
  BodyId body;
  std::uint32_t enabled;  // 1, or 0: disabled
  ISO_FIELDS(body, enabled)
};
template <class S> struct SetType {
  BodyId body;
  BodyType type;
  BodyMass<S> mass = {};  // of a dynamic one
  ISO_FIELDS(body, type, mass)
};
template <class S> struct SetMass {
  BodyId body;
  BodyMass<S> mass;
  ISO_FIELDS(body, mass)
};
/// Gives a body another shape; its origin stays where it is.
template <class S> struct SetShape {
  BodyId body;
  ShapeId shape;
  BodyMass<S> mass = {};  // of a dynamic one
  ISO_FIELDS(body, shape, mass)
};
/// The body's island falls asleep at once.
struct SleepBody {
  BodyId body;
  ISO_FIELDS(body)
};
/// The next step carries a kinematic body there: see World::move_to.
template <class S> struct MoveTo {
  BodyId body;
  Pose<S> pose;  // of the body's origin
  ISO_FIELDS(body, pose)
};

template <class Record> using SetRecordOf = SetRecord<Record, typename detail::RecordIdOf<Record>::Type>;
template <class Input> using SetInputOf = SetInput<Input, typename detail::RecordIdOf<Input>::Type>;

/// ISO_FOR_EACH_COMMAND(X, S) expands X(name, Type, Result, S) for each command: its name in faults, its record, and
/// what `World<S>::apply` and `execute` return: the id of what was made, or whether it was accepted. To add one: its
/// record above, its line here, its `execute`; see README.md. Each kind of record has three commands, and one for its
/// input. The position is the number in replays.
#define ISO_FOR_EACH_COMMAND(X, S)                    \
  X(add_shape, AddShape<S>, ShapeId, S)               \
  X(remove_shape, RemoveShape, bool, S)               \
  X(set_heights, SetHeights, bool, S)                 \
  X(create_body, CreateBody<S>, BodyId, S)            \
  X(destroy_body, DestroyBody, bool, S)               \
  X(wake_body, WakeBody, bool, S)                     \
  X(sleep_body, SleepBody, bool, S)                   \
  X(set_pose, SetPose<S>, bool, S)                    \
  X(move_to, MoveTo<S>, bool, S)                      \
  X(set_velocity, SetVelocity<S>, bool, S)            \
  X(apply_force, ApplyForce<S>, bool, S)              \
  X(apply_impulse, ApplyImpulse<S>, bool, S)          \
  X(set_material, SetMaterial<S>, bool, S)            \
  X(set_filter, SetFilter, bool, S)                   \
  X(set_motion, SetMotion<S>, bool, S)                \
  X(set_user_data, SetUserData, bool, S)              \
  X(set_enabled, SetEnabled, bool, S)                 \
  X(set_type, SetType<S>, bool, S)                    \
  X(set_mass, SetMass<S>, bool, S)                    \
  X(set_shape, SetShape<S>, bool, S)                  \
  X(set_gravity, SetGravity<S>, bool, S)              \
  X(create_joint, CreateJoint<S>, JointId, S)         \
  X(destroy_joint, DestroyJoint, bool, S)             \
  X(set_joint, SetJoint<S>, bool, S)                  \
  X(set_joint_limits, SetJointLimits<S>, bool, S)     \
  X(set_joint_motor, SetJointMotor<S>, bool, S)       \
  X(set_joint_spring, SetJointSpring<S>, bool, S)     \
  X(set_joint_target, SetJointTarget<S>, bool, S)     \
  X(set_wheel_spin, SetWheelSpin<S>, bool, S)         \
  ISO_FOR_EACH_RECORD_WITH(ISO_RECORD_COMMANDS, X, S) \
  ISO_FOR_EACH_INPUT_WITH(ISO_INPUT_COMMAND, X, S)
#define ISO_RECORD_COMMANDS(X, name, Record, Id, S) \
  X(add_##name, AddRecord<Record>, Id, S)           \
  X(set_##name, SetRecordOf<Record>, bool, S)       \
  X(remove_##name, RemoveRecord<Id>, bool, S)
#define ISO_INPUT_COMMAND(X, name, Input, Id, S) X(set_##name##_input, SetInputOf<Input>, bool, S)

#define ISO_TYPE(name, Type, Result, S) , Type
template <class S> using EveryCommand = CommandTypes<void ISO_FOR_EACH_COMMAND(ISO_TYPE, S)>;
#undef ISO_TYPE

#define ISO_NAME(name, Type, Result, S) #name,
inline constexpr const char* kCommandNames[] = {ISO_FOR_EACH_COMMAND(ISO_NAME, float)};  // by number
#undef ISO_NAME

}  // namespace isostep
