// The list of all structs of the C interface, from which its header, its layout checks and its functions are made.
// SPDX-License-Identifier: MIT
#pragma once

#include "enums.hpp"
#include "twins.hpp"

// X(name, Type, S): iso_NAME of a family, and its C++ twin over the scalar S.

/// Structs that stand within others or in arrays. They have no size member, so they never grow.
#define ISO_C_PLAIN(X, S)              \
  X(vec3, Vec3<S>, S)                  \
  X(unit_vec3, Vec3<Unit<S>>, S)       \
  X(quat, Quat<Unit<S>>, S)            \
  X(pose, Pose<S>, S)                  \
  X(mat3, Mat3<S>, S)                  \
  X(aabb, Aabb<S>, S)                  \
  X(material, Material<S>, S)          \
  X(primitive, Primitive<S>, S)        \
  X(part_traits, PartTraits<S>, S)     \
  X(child, Child<S>, S)                \
  X(joint_range, JointRange<S>, S)     \
  X(joint_motor, JointMotor<S>, S)     \
  X(joint_spring, JointSpring<S>, S)   \
  X(joint_servo, JointServo<S>, S)     \
  X(drive, AxisDrive<S>, S)            \
  X(ragdoll_bone, RagdollBone<S>, S)   \
  X(ray_hit, RayCastHit<S>, S)         \
  X(shape_hit, ShapeCastHit<S>, S)     \
  X(closest_body, ClosestBody<S>, S)   \
  X(contact_begin, ContactBegin<S>, S) \
  X(broke, Broke<S>, S)                \
  X(joint_broke, JointBroke<S>, S)     \
  X(contact_hit, ContactHit<S>, S)     \
  X(contact_point, ContactPoint<S>, S)

/// Shapes without a blob.
#define ISO_C_SHAPES(X, S)       \
  X(sphere, Sphere<S>, S)        \
  X(box, Box<S>, S)              \
  X(capsule, Capsule<S>, S)      \
  X(half_space, HalfSpace<S>, S) \
  X(cylinder, Cylinder<S>, S)    \
  X(cone, Cone<S>, S)

/// Joints by the names of joint_presets.hpp's fields. A wheel is a record too.
#define ISO_C_JOINTS(X, S)               \
  X(ball, SwingJoint<S>, S)              \
  X(constant_velocity, SwingJoint<S>, S) \
  X(fixed, PlainJoint<S>, S)             \
  X(universal, PlainJoint<S>, S)         \
  X(angular, PlainJoint<S>, S)           \
  X(hinge, OneAxisJoint<S>, S)           \
  X(slider, OneAxisJoint<S>, S)          \
  X(cylindrical, OneAxisJoint<S>, S)     \
  X(planar, OneAxisJoint<S>, S)          \
  X(rod, TwoPointJoint<S>, S)            \
  X(rope, TwoPointJoint<S>, S)           \
  X(wheel_joint, WheelJoint<S>, S)       \
  X(motor_joint, MotorJoint<S>, S)       \
  X(six_axis, SixAxisDefinition<S>, S)

/// Structs that go by pointer and begin with their size, without records.
#define ISO_C_SIZED(X, S)                    \
  X(settings, Settings<S>, S)                \
  X(body_definition, BodyDefinition<S>, S)   \
  X(body_mass, BodyMass<S>, S)               \
  X(body_state, CBodyState<S>, S)            \
  X(body_properties, CBodyProperties<S>, S)  \
  ISO_C_SHAPES(X, S)                         \
  X(hull, CHull<S>, S)                       \
  X(joint_properties, JointProperties<S>, S) \
  ISO_C_JOINTS(X, S)                         \
  X(ragdoll_settings, RagdollSettings<S>, S) \
  X(ray_cast, CRayCast<S>, S)                \
  X(shape_cast, CShapeCast<S>, S)            \
  X(overlap_query, COverlapQuery<S>, S)      \
  X(point_query, CPointQuery<S>, S)          \
  X(box_query, CBoxQuery<S>, S)

// The same of structs without numbers: X(name, Type).
#define ISO_C_COMMON_PLAIN(X)   \
  X(filter, Filter)             \
  X(query_filter, CQueryFilter) \
  X(overlap_hit, OverlapHit)    \
  X(body_pair, ContactEnd)      \
  X(sensor_event, SensorEvent)  \
  X(render_pose, RenderPose)

#define ISO_C_COMMON_SIZED(X)             \
  X(step_report, StepReport)              \
  X(world_counts, WorldCounts)            \
  X(break_report, BreakReport)            \
  X(fault_report, CFaultReport)           \
  X(height_patch, CHeightPatch)           \
  X(height_grid, HeightGrid)              \
  X(height_sheet, CHeightSheet)           \
  X(triangles, CTriangles)                \
  X(surface_materials, CSurfaceMaterials) \
  X(replay_info, CReplayInfo)             \
  X(replay_result, CReplayResult)         \
  X(selfcheck_result, CSelfcheckResult)

/// The C++ twin of a family's struct by its name in C: twin::body_definition<S>.
namespace isostep::c::twin {
#define ISO_ALIAS(name, Type, S) template <class S> using name = Type;
#define ISO_RECORD_ALIAS(name, Type, Id, S) template <class S> using name = Type;
#define ISO_INPUT_ALIAS(name, Type, Id, S) template <class S> using name##_input = Type;
#define ISO_STATE_ALIAS(name, Type, Id, S) template <class S> using name##_state = Type;
ISO_C_PLAIN(ISO_ALIAS, S)
ISO_C_SIZED(ISO_ALIAS, S)
ISO_FOR_EACH_RECORD(ISO_RECORD_ALIAS, S)
ISO_FOR_EACH_INPUT(ISO_INPUT_ALIAS, S)
ISO_FOR_EACH_RECORD_STATE(ISO_STATE_ALIAS, S)
#undef ISO_ALIAS
#undef ISO_RECORD_ALIAS
#undef ISO_INPUT_ALIAS
#undef ISO_STATE_ALIAS
}  // namespace isostep::c::twin
