// The C++ side of C structs whose C++ types have no `fields` of their own, and of those that C++ has no type for.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "family.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/effects/ragdoll.hpp"
#include "isostep/fracture/breaking.hpp"
#include "isostep/world/world.hpp"
#include "layout.hpp"

namespace isostep::c {

// ---- What C++ has other types for

/// QueryFilter with its lists as pointers and counts.
struct CQueryFilter {
  std::uint32_t mask = 0xffffffffu;  // categories that are seen
  bool sensors = false;              // sensors are seen too
  bool back_faces = false;           // rays and casts hit triangles from behind too
  BodyId ignore = {};                // is not seen
  std::uint32_t group = 0;           // bodies of this filter.group are not seen; 0: none
  StartInside start_inside = StartInside::report;
  HitPer per = HitPer::body;                 // what a list of hits has one of
  std::uint32_t ignore_all_count = 0;        // ids of ignore_all
  Pointer<std::uint64_t> ignore_all = {};    // iso_body: are not seen either
  std::uint32_t ignore_kinds_count = 0;      // numbers of ignore_kinds
  std::uint32_t reserved = 0;                // 0
  Pointer<std::uint32_t> ignore_kinds = {};  // nor are bodies of these material.kind
  ISO_FIELDS(mask, sensors, back_faces, ignore, group, start_inside, per, ignore_all_count, ignore_all,
             ignore_kinds_count, reserved, ignore_kinds)
};

template <class S> struct CRayCast {
  Vec3<S> origin = Vec3<S>::zero();       // [m] world
  Vec3<S> translation = Vec3<S>::zero();  // [m]
  CQueryFilter filter = {};
  ISO_FIELDS(origin, translation, filter)
};
template <class S> struct CShapeCast {
  ShapeId shape = {};                     // of the world, of a single convex part; null: `primitive`
  Primitive<S> primitive = {};            // without a blob
  Pose<S> pose = Pose<S>::identity();     // [m] of the shape's frame at the start, world
  Vec3<S> translation = Vec3<S>::zero();  // [m]
  CQueryFilter filter = {};
  ISO_FIELDS(shape, primitive, pose, translation, filter)
};
template <class S> struct COverlapQuery {
  ShapeId shape = {};                  // of the world, of a single convex part; null: `primitive`
  Primitive<S> primitive = {};         // without a blob
  Pose<S> pose = Pose<S>::identity();  // [m] of the shape's frame, world
  CQueryFilter filter = {};
  ISO_FIELDS(shape, primitive, pose, filter)
};
template <class S> struct CPointQuery {
  Vec3<S> point = Vec3<S>::zero();  // [m] world
  S max_distance = S(1);            // [m]
  CQueryFilter filter = {};
  ISO_FIELDS(point, max_distance, filter)
};
template <class S> struct CBoxQuery {
  Aabb<S> box = {Vec3<S>::zero(), Vec3<S>::zero()};  // [m] world
  CQueryFilter filter = {};
  ISO_FIELDS(box, filter)
};

/// The motion of a body, and what is asked most often beside it.
template <class S> struct CBodyState {
  Pose<S> pose = Pose<S>::identity();          // [m] of the body's origin, world
  Vec3<S> centre = Vec3<S>::zero();            // [m] centre of mass, world
  Vec3<S> velocity = Vec3<S>::zero();          // [m/s] of the centre of mass
  Vec3<S> angular_velocity = Vec3<S>::zero();  // [rad/s] world
  std::uint64_t user_data = 0;
  BodyType type = BodyType::static_;
  bool awake = false;
  bool enabled = true;
  ISO_FIELDS(pose, centre, velocity, angular_velocity, user_data, type, awake, enabled)
};
/// The properties of a body that only commands change.
template <class S> struct CBodyProperties {
  BodyType type = BodyType::static_;
  std::uint32_t flags = 0;  // ISO_BODY_FLAG_...
  Filter filter = {};
  std::uint64_t user_data = 0;
  S mass = S(0);                           // [kg]
  Vec3<S> local_centre = Vec3<S>::zero();  // [m] centre of mass, body frame
  Material<S> material = {};
  S gravity_scale = S(1);    // [1]
  S linear_damping = S(0);   // [1/s]
  S angular_damping = S(0);  // [1/s]
  ISO_FIELDS(type, flags, filter, user_data, mass, local_centre, material, gravity_scale, linear_damping,
             angular_damping)
};

/// The radius of a hull; its points are in a blob.
template <class S> struct CHull {
  S radius = S(0);  // [m] around the core
  ISO_FIELDS(radius)
};

struct CFaultReport {
  std::int32_t status = 0;      // 0, or the Fault
  std::uint32_t reserved = 0;   // 0
  Pointer<char> command = {};   // "apply_force"
  Pointer<char> field = {};     // "material.friction"; empty: no field alone
  Pointer<char> expected = {};  // "0 to 16"
  ISO_FIELDS(status, reserved, command, field, expected)
};

struct CHeightPatch {
  std::uint32_t column = 0, row = 0;     // of its first place
  std::uint32_t columns = 0, rows = 0;   // places along each side
  Pointer<std::int16_t> heights = {};    // columns times rows, by rows, in units of the field's height
  Pointer<std::uint8_t> materials = {};  // of the (columns - 1) times (rows - 1) cells between; null: they stay
  ISO_FIELDS(column, row, columns, rows, heights, materials)
};
struct CHeightSheet {
  std::uint32_t columns = 0, rows = 0;
  double pitch = 1;              // [m] between columns, and between rows
  Pointer<double> heights = {};  // [m] columns times rows, by rows
  ISO_FIELDS(columns, rows, pitch, heights)
};
struct CTriangles {
  std::uint32_t point_count = 0, triangle_count = 0;
  Pointer<double> points = {};           // [m] x, y, z of each
  Pointer<std::uint32_t> vertices = {};  // three a triangle, counter-clockwise seen from its outward side
  ISO_FIELDS(point_count, triangle_count, points, vertices)
};
/// Materials of a mesh's triangles or of a height field's cells.
struct CSurfaceMaterials {
  std::uint32_t count = 0;             // of numbers: one a triangle or cell; 0: all have number 0
  std::uint32_t table_count = 0;       // of table: what number 0 stands for, then 1 ...; beyond: the body's own
  Pointer<std::uint8_t> numbers = {};  // 254: a ghost, 255: a hole of a height field
  Pointer<double> table = {};          // friction and restitution of each
  ISO_FIELDS(count, table_count, numbers, table)
};

struct CReplayInfo {
  std::uint64_t behaviour = 0;    // behaviour version that it was recorded with
  std::uint64_t frames = 0;       // in whole blocks
  std::uint64_t start_hash = 0;   // of the state before the first
  std::uint64_t first_frame = 0;  // the number that the game gives to its first
  std::uint64_t keyframes = 0;
  VerifyOutcome file = VerifyOutcome::verified;  // what the file alone says: verified, incompatible, truncated, corrupt
  std::uint32_t hz = 0;                          // [1/s] steps
  std::uint32_t substeps = 0;
  bool has_state = false;  // the start is there
  char scalar[32] = {};    // "q32.32"; empty where the file does not tell
  char scene[136] = {};
  char world[32] = {};   // its kind; empty: rigid bodies
  char engine[32] = {};  // the version that recorded it
  ISO_FIELDS(behaviour, frames, start_hash, first_frame, keyframes, file, hz, substeps, has_state, scalar, scene, world,
             engine)
};
struct CReplayResult {
  VerifyOutcome outcome = VerifyOutcome::verified;         // its number is the exit status of `isostep verify`
  VerifyResult::Where where = VerifyResult::Where::start;  // of what diverged
  std::uint64_t frames = 0;    // compared; else the frame that diverged, or the first that is missing or not played
  std::uint64_t expected = 0;  // diverged: the replay's hash
  std::uint64_t actual = 0;    // diverged: the hash here
  std::uint64_t offset = 0;    // [bytes] truncated, corrupt: the place in the file
  char scalar[32] = {};
  char scene[136] = {};
  char lanes[16] = {};  // that stepped it; empty: nothing did
  char text[512] = {};  // the outcome as a sentence
  ISO_FIELDS(outcome, where, frames, expected, actual, offset, scalar, scene, lanes, text)
};
struct CSelfcheckResult {
  bool sound = false;            // every scalar with every set of lanes has frames that agree, and none that does not
  std::uint32_t engine = 0;      // deviations of the library's arithmetic, 0 on a sound machine
  std::uint32_t recordings = 0;  // replayed
  std::uint32_t failed = 0;      // of these
  std::uint64_t frames = 0;      // whose hashes were computed again and agreed
  char text[512] = {};           // one line
  ISO_FIELDS(sound, engine, recordings, failed, frames, text)
};

// ---- Fields of what has none in C++

#define ISO_C_FIELDS_OF(Type) \
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self)
#define ISO_MEMBER(name) visit(#name, self.name);

template <class S> struct CFields<JointRange<S>> {
  ISO_C_FIELDS_OF(JointRange) { ISO_MEMBER(lower) ISO_MEMBER(upper) }
};
template <class S> struct CFields<JointMotor<S>> {
  ISO_C_FIELDS_OF(JointMotor) { ISO_MEMBER(speed) ISO_MEMBER(max_force) }
};
template <class S> struct CFields<JointSpring<S>> {
  ISO_C_FIELDS_OF(JointSpring) { ISO_MEMBER(frequency) ISO_MEMBER(damping) ISO_MEMBER(target) }
};
template <class S> struct CFields<JointServo<S>> {
  ISO_C_FIELDS_OF(JointServo) {
    ISO_MEMBER(frequency) ISO_MEMBER(damping) ISO_MEMBER(target) ISO_MEMBER(max_force) ISO_MEMBER(mass)
  }
};
template <class S> struct CFields<PlainJoint<S>> {
  ISO_C_FIELDS_OF(PlainJoint) { ISO_MEMBER(a) ISO_MEMBER(b) ISO_MEMBER(frame) ISO_MEMBER(collide) }
};
template <class S> struct CFields<OneAxisJoint<S>> {
  ISO_C_FIELDS_OF(OneAxisJoint) {
    ISO_MEMBER(a)
    ISO_MEMBER(b) ISO_MEMBER(frame) ISO_MEMBER(limit) ISO_MEMBER(motor) ISO_MEMBER(spring) ISO_MEMBER(collide)
  }
};
template <class S> struct CFields<SwingJoint<S>> {
  ISO_C_FIELDS_OF(SwingJoint) {
    ISO_MEMBER(a) ISO_MEMBER(b) ISO_MEMBER(frame) ISO_MEMBER(cone) ISO_MEMBER(twist) ISO_MEMBER(collide)
  }
};
template <class S> struct CFields<TwoPointJoint<S>> {
  ISO_C_FIELDS_OF(TwoPointJoint) {
    ISO_MEMBER(a)
    ISO_MEMBER(b) ISO_MEMBER(anchor_a) ISO_MEMBER(anchor_b) ISO_MEMBER(length) ISO_MEMBER(spring) ISO_MEMBER(collide)
  }
};
template <class S> struct CFields<WheelJoint<S>> {
  ISO_C_FIELDS_OF(WheelJoint) {
    ISO_MEMBER(a)
    ISO_MEMBER(b)
    ISO_MEMBER(frame) ISO_MEMBER(suspension) ISO_MEMBER(travel) ISO_MEMBER(steer) ISO_MEMBER(drive) ISO_MEMBER(collide)
  }
};
template <class S> struct CFields<MotorJoint<S>> {
  ISO_C_FIELDS_OF(MotorJoint) {
    ISO_MEMBER(a)
    ISO_MEMBER(b) ISO_MEMBER(frame_a) ISO_MEMBER(frame_b) ISO_MEMBER(place) ISO_MEMBER(turn) ISO_MEMBER(collide)
  }
};
template <class S> struct CFields<SixAxisDefinition<S>> {
  ISO_C_FIELDS_OF(SixAxisDefinition) {
    ISO_MEMBER(a)
    ISO_MEMBER(b) ISO_MEMBER(frame) ISO_MEMBER(locks) ISO_MEMBER(drives) ISO_MEMBER(drive_count) ISO_MEMBER(collide)
  }
};
template <class S> struct CFields<RagdollBone<S>> {
  ISO_C_FIELDS_OF(RagdollBone) {
    ISO_MEMBER(parent)
    ISO_MEMBER(shape)
    ISO_MEMBER(pose)
    ISO_MEMBER(mass)
    ISO_MEMBER(joint) ISO_MEMBER(hinge) ISO_MEMBER(swing_x) ISO_MEMBER(swing_y) ISO_MEMBER(lower) ISO_MEMBER(upper)
  }
};
template <class S> struct CFields<RagdollSettings<S>> {
  ISO_C_FIELDS_OF(RagdollSettings) {
    ISO_MEMBER(friction)
    ISO_MEMBER(pose) ISO_MEMBER(limit_frequency) ISO_MEMBER(limit_damping) ISO_MEMBER(filter) ISO_MEMBER(material)
  }
};
template <class S> struct CFields<Sphere<S>> {
  ISO_C_FIELDS_OF(Sphere) { ISO_MEMBER(radius) }
};
template <class S> struct CFields<Box<S>> {
  ISO_C_FIELDS_OF(Box) { ISO_MEMBER(half_extents) }
};
template <class S> struct CFields<Capsule<S>> {
  ISO_C_FIELDS_OF(Capsule) { ISO_MEMBER(radius) ISO_MEMBER(half_height) }
};
template <class S> struct CFields<Cylinder<S>> {
  ISO_C_FIELDS_OF(Cylinder) { ISO_MEMBER(radius) ISO_MEMBER(half_height) }
};
template <class S> struct CFields<Cone<S>> {
  ISO_C_FIELDS_OF(Cone) { ISO_MEMBER(radius) ISO_MEMBER(half_height) }
};
template <class S> struct CFields<HalfSpace<S>> {
  ISO_C_FIELDS_OF(HalfSpace) { ISO_MEMBER(normal) ISO_MEMBER(offset) }
};
template <class S, class Fraction> struct CFields<QueryHit<S, Fraction>> {
  ISO_C_FIELDS_OF(QueryHit) {
    ISO_MEMBER(body)
    ISO_MEMBER(child)
    ISO_MEMBER(triangle)
    ISO_MEMBER(point) ISO_MEMBER(normal) ISO_MEMBER(fraction) ISO_MEMBER(material) ISO_MEMBER(inside)
  }
};
template <> struct CFields<OverlapHit> {
  ISO_C_FIELDS_OF(OverlapHit) { ISO_MEMBER(body) ISO_MEMBER(child) ISO_MEMBER(triangle) ISO_MEMBER(material) }
};
template <class S> struct CFields<ClosestBody<S>> {
  ISO_C_FIELDS_OF(ClosestBody) {
    ISO_MEMBER(body) ISO_MEMBER(child) ISO_MEMBER(point) ISO_MEMBER(normal) ISO_MEMBER(distance)
  }
};
template <> struct CFields<RenderPose> {
  ISO_C_FIELDS_OF(RenderPose) { ISO_MEMBER(body) ISO_MEMBER(position) ISO_MEMBER(orientation) }
};
template <> struct CFields<WorldCounts> {
  ISO_C_FIELDS_OF(WorldCounts) {
    ISO_MEMBER(bodies)
    ISO_MEMBER(static_bodies)
    ISO_MEMBER(awake) ISO_MEMBER(asleep) ISO_MEMBER(contacts) ISO_MEMBER(points) ISO_MEMBER(joints) ISO_MEMBER(shapes)
  }
};
template <> struct CFields<BreakReport> {
  ISO_C_FIELDS_OF(BreakReport) { ISO_MEMBER(broken) ISO_MEMBER(pieces) ISO_MEMBER(whole) ISO_MEMBER(expired) }
};

#undef ISO_MEMBER
#undef ISO_C_FIELDS_OF

}  // namespace isostep::c
