// World<S>: rigid bodies, their contacts and joints, stepped at a fixed rate; saved, loaded and hashed exactly.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/broad_phase_name.hpp"
#include "isostep/commands/command.hpp"
#include "isostep/core/fault.hpp"
#include "isostep/core/id.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/core/task_runner.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/settings.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/state/world_base.hpp"
#include "isostep/store/definitions.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/query_types.hpp"
#include "isostep/store/resimulation.hpp"
#include "isostep/store/stages.hpp"
#include "isostep/store/views.hpp"
#include "isostep/world/joint_presets.hpp"

namespace isostep {

template <class S> struct WorldState;
template <class S> class WorldEngine;
template <class S> class World;

template <class S> struct WorldParts<World<S>> {
  using Settings = isostep::Settings<S>;
  using State = WorldState<S>;
  using Engine = WorldEngine<S>;
  using EveryCommand = isostep::EveryCommand<S>;
  static constexpr std::uint32_t kStages = isostep::kStages;
  static constexpr const char* kName = "world";
};

/// A rigid-body world over any scalar. Its base has faults, recording, save, load, hash and the portable form.
///
/// Mutators act at once, between steps. A refused one returns false or a null id, changes nothing and leaves its reason
/// in `fault()`. Stage observers call none. One thread at a time calls mutators and `step`; between them any number may
/// query. Two worlds of one type that get the same calls in the same order have equal hashes at every tick, on every
/// machine. `load(save(w))` restores ids, contacts, sleep and the future exactly.
///
/// A game has a World as a member, beside its own state: see Composite (state/composite.hpp).
///
/// Frames: right-handed, world axes fixed, y up by the default gravity. Units: kg, m, s, rad.
template <class S> class World final : public WorldBase<World<S>> {
  ISO_REQUIRE_ENGINE(S);
  using Base = WorldBase<World<S>>;

 public:
  using Scalar = S;
  using EveryCommand = isostep::EveryCommand<S>;

  /// Clamps settings to their ranges and reports a fault for those out of range. A solver that the build leaves out
  /// (ISOSTEP_BOOK) is a fault too, and soft_step replaces it.
  explicit World(const Settings<S>& settings = {}) : Base(settings) {}

  /// Sets the SIMD instruction set. Never changes a bit. False, with no change: the CPU or the build lacks it.
  bool use_simd(Simd simd);
  const char* simd_name() const;
  /// Sets the broad phase of steps and queries. The default is the tree of boxes. Never changes a bit. Grids move and
  /// insert proxies faster, the tree finds pairs faster. Refuses a broad phase that the build leaves out (ISOSTEP_BOOK)
  /// with a fault.
  bool use_broad_phase(BroadPhaseName name);
  BroadPhaseName broad_phase() const;
  /// Sets the threads that help with every later step. The default is none. Never changes a bit. Small worlds use the
  /// calling thread alone. What `runner` points to must outlive the world or the next call.
  void use_threads(const TaskRunner& runner);
  /// Sets the source of blobs that states and commands name without their content: BlobHome::asset. Default: none.
  void use_assets(const AssetSource& assets);

  // Bodies share shapes. add_shape takes any shape of the list, either with the world's scalar, or with literals:
  // Box{{0.5, 0.5, 0.5}}.
#define ISO_ADD_SHAPE(name, Shape)          \
  ShapeId add_shape(const Shape<S>& shape); \
  ShapeId add_shape(const Shape<Literal>& shape);
  ISO_FOR_EACH_SHAPE(ISO_ADD_SHAPE)
#undef ISO_ADD_SHAPE
  /// Adds a shape that is one blob: a hull, a mesh or a height field.
  ShapeId add_shape(const BlobRef& blob);
  /// Adds a compound. A child names a blob by Primitive::blob, which is 1 + its index in `blobs`.
  ShapeId add_shape(std::span<const Child<S>> children, std::span<const BlobRef> blobs = {});
  bool remove_shape(ShapeId shape);
  /// Replaces heights, and materials, in a rectangle of the height field that is that child of the shape.
  bool set_heights(ShapeId shape, std::uint32_t child, const HeightPatch& patch);
  /// Returns the height field, valid until the next command or load, or null if the child is no height field.
  const BakedHeightField* height_field(ShapeId shape, std::uint32_t child = 0) const;

  // Bodies.
  BodyId create(const BodyDefinition<S>& definition);
  bool destroy(BodyId body);
  /// Destroys bodies in this order, like single calls, in about one pass over the awake bodies. Returns how many.
  std::size_t destroy(std::span<const BodyId> bodies);
  bool wake(BodyId body);
  bool set_pose(BodyId body, const Pose<S>& pose);
  bool set_velocity(BodyId body, Vec3<S> linear, Vec3<S> angular);
  bool set_material(BodyId body, const Material<S>& material);
  bool set_filter(BodyId body, const Filter& filter);
  bool set_motion(BodyId body, S gravity_scale, S linear_damping, S angular_damping, std::uint32_t locks);
  bool set_user_data(BodyId body, std::uint64_t user_data);
  /// Disables a body, or enables it again. A disabled body keeps its id, pose, velocity, joints and records. It does
  /// not move, has no contacts, and no query or sensor finds it. Its joints, couplings and springs have no effect, nor
  /// have its other records. Disabling ends its contacts and wakes what it touched. Pose, mass, type, material and
  /// filter can still be set; commands that set it in motion are refused. Enabling restores the body as it was, awake.
  /// Setting the current value has no effect.
  bool set_enabled(BodyId body, bool enabled);
  /// Changes the type of a body, which keeps its id, shape, joints and records. `mass` is for a body that becomes
  /// dynamic. A body that becomes static loses its velocity, others keep it. Contacts end and begin anew. A joint
  /// without a dynamic body has no effect. Refuses a dynamic body whose shape has no volume, a type that one of its
  /// records may not name, and a body too light for its joints.
  bool set_type(BodyId body, BodyType type, const BodyMass<S>& mass = {});
  /// Sets the mass and inertia of a dynamic body, as if it had been created with them. It keeps its velocity. Forces
  /// already applied for the next step keep the acceleration that they give the old mass.
  bool set_mass(BodyId body, const BodyMass<S>& mass);
  /// Changes the shape of a body: growth, crouching, damage. It keeps its id, pose of the origin, velocity, joints and
  /// records. Contacts end and begin anew, and the solver pushes new overlaps apart. Without a `mass` a dynamic body
  /// keeps its mass and gets the inertia of the shape. Refuses a shape without a volume for a dynamic body, and a shape
  /// that conflicts with a record or joint of the body.
  bool set_shape(BodyId body, ShapeId shape);
  bool set_shape(BodyId body, ShapeId shape, const BodyMass<S>& mass);
  /// Puts the island of a dynamic body to sleep at once. Its bodies stop and lose forces applied for the next step,
  /// which lists them in `fell_asleep`. Refused if a body of the island may not sleep, or if the settings forbid sleep.
  /// A moving body that touches the island wakes it, in the next step if it already does so.
  bool sleep(BodyId body);
  /// Makes the next step carry a kinematic body to a pose. In that step its velocity leads there, along a line and
  /// about one axis by the shorter way, so that it pushes and carries what it touches. Locks do not hold it. At the end
  /// of the step it lies exactly at the pose and stands still. A step moves a body by at most Limits::speed(), and by a
  /// radian a sub-step: a body with a target further away goes as far as that and stops. Overrides any velocity that
  /// was set. A second call before the step replaces the target. A disabled body moves in the first step after it is
  /// enabled again.
  bool move_to(BodyId body, const Pose<S>& pose);
  bool set_gravity(Vec3<S> gravity);  // [m/s^2] world
  /// Adds a force [N] and a torque [N m], in world axes, for the whole next step. `point` [m] is in world space.
  bool apply_force(BodyId body, Vec3<S> force, Vec3<S> torque = {S(0), S(0), S(0)});
  bool apply_force_at(BodyId body, Vec3<S> force, Vec3<S> point);
  /// Applies an impulse [kg m/s] and an angular impulse [kg m^2/s], in world axes. Velocities change at once.
  bool apply_impulse(BodyId body, Vec3<S> impulse, Vec3<S> angular_impulse = {S(0), S(0), S(0)});
  bool apply_impulse_at(BodyId body, Vec3<S> impulse, Vec3<S> point);

  // Joints.
  /// Returns a joint whose two frames both lie at `frame` (world space, a unit quaternion) now. A null id is the world.
  /// Add limits, motor and spring to it, then call create.
  JointProperties<S> joint_at(JointType type, BodyId a, BodyId b, const Pose<S>& frame) const;
  /// Returns a joint whose two frames are given in world space.
  JointProperties<S> joint_between(JointType type, BodyId a, const Pose<S>& frame_a, BodyId b,
                                   const Pose<S>& frame_b) const;
  JointId create(const JointProperties<S>& joint);
  /// Creates a joint of joint_presets.hpp with its AxisDrives: the joint and all drives or, with a fault, nothing.
  JointId create(const JointDefinition<S>& joint);
  bool destroy(JointId joint);
  bool set_joint(JointId joint, const JointProperties<S>& properties);
  /// Set one part, along joint_position(). set_joint sets all of them. A six-axis joint has AxisDrives instead.
  bool set_limits(JointId joint, S lower, S upper);        // [rad] or [m]
  bool set_motor(JointId joint, S speed, S max_force);     // [rad/s], [N m] or [m/s], [N]; max_force 0: no motor
  bool set_spring(JointId joint, S frequency, S damping);  // [Hz], [1] 1 is critical; frequency 0: no spring
  bool set_target(JointId joint, S target);                // [rad] or [m] that the spring pulls to
  const JointProperties<S>* joint(JointId joint) const;
  /// Returns the distance between the anchors [m], or the length error of a distance joint [m]. 0 for a stale id.
  S joint_error(JointId joint) const;
  /// Returns the coordinate of lower, upper and spring_target: the twist of b against a about z in (-pi, pi] [rad]; the
  /// travel along z of a for a slider or cylindrical joint, the length for a distance joint [m]. 0 for a stale id.
  S joint_position(JointId joint) const;
  /// Returns the position on one axis of a six-axis joint: the travel [m], or the angle in (-pi, pi] [rad].
  S joint_position(JointId joint, JointAxis axis) const;
  /// Returns the drive on one axis of a six-axis joint, also of a preset or ragdoll. Use find, set and remove with it,
  /// for example to change the target of a servo or the speed of a motor. Null if the axis has none.
  AxisDriveId axis_drive(JointId joint, JointAxis axis) const;

  // Records: each kind of record_list.hpp. A record acts on awake bodies. Adding, changing or removing one wakes the
  // bodies it acts on. Destroying a body or joint removes the records that name it.
#define ISO_RECORD(name, Record, Id, S)                      \
  Id add(const Record& record);                              \
  bool set(Id id, const Record& record);                     \
  bool remove(Id id);                                        \
  /* Null for a stale id; until the next command or load. */ \
  const Record* find(Id id) const;
  ISO_FOR_EACH_RECORD(ISO_RECORD, S)
#undef ISO_RECORD
  /// The input that a game gives a record. It lasts until the next set_input. Null for a stale id.
#define ISO_INPUT(name, Input, Id, S)        \
  bool set_input(Id id, const Input& input); \
  const Input* input(Id id) const;
  ISO_FOR_EACH_INPUT(ISO_INPUT, S)
#undef ISO_INPUT
  /// Sets the spin [rad/s] of a wheel, for example when a car is placed on the road at speed.
  bool set_spin(WheelId wheel, S spin);
  using Base::state;
  /// Returns the state of a record after the last step. Null for a stale id.
#define ISO_STATE(name, State, Id, S) const State* state(Id id) const;
  ISO_FOR_EACH_RECORD_STATE(ISO_STATE, S)
#undef ISO_STATE

  /// Applies a command. Every mutator above is a command with its fields as arguments: command.hpp.
#define ISO_APPLY(name, Type, Result, S) Result apply(const Type& command);
  ISO_FOR_EACH_COMMAND(ISO_APPLY, S)
#undef ISO_APPLY

  // Getters of bodies. For a stale id they return the zero of their type.
  bool contains(BodyId body) const;
  bool contains(ShapeId shape) const;
  bool contains(JointId joint) const;
  bool is_awake(BodyId body) const;
  bool is_enabled(BodyId body) const;
  BodyType type(BodyId body) const;
  Pose<S> pose(BodyId body) const;
  Vec3<S> center_of_mass(BodyId body) const;
  Vec3<S> velocity(BodyId body) const;
  Vec3<S> angular_velocity(BodyId body) const;
  /// Returns the velocity [m/s] of a point [m] that moves with the body, both in world space.
  Vec3<S> velocity_at(BodyId body, Vec3<S> point) const;
  S mass(BodyId body) const;
  /// Returns the inertia [kg m^2] about a world axis [1] through the centre of mass. 0: not dynamic, or a locked axis.
  S inertia(BodyId body, Vec3<Unit<S>> axis) const;
  std::uint64_t user_data(BodyId body) const;
  std::vector<BodyId> bodies() const;
  std::vector<JointId> joints() const;
  WorldCounts counts() const;

  // Queries see the world after the last step or command. QueryFilter (query_types.hpp) selects what they see. Results
  // are a function of the state: a world that loads a snapshot gives the same results as the world that saved it.
  /// Returns the first hit.
  std::optional<RayCastHit<S>> cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter = {}) const;
  /// Appends the first hit of every body, child or triangle (QueryFilter::per) on the way to `out`, in order.
  void cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                    QueryFilter filter = {}) const;
  /// Writes the nearest hits that `out` has room for, in order, and returns their number. Allocates nothing.
  std::size_t cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::span<RayCastHit<S>> out,
                           QueryFilter filter = {}) const;
  /// Returns the first hit of a convex shape that moves along a translation without turning. An initial overlap of up
  /// to 1/64 m, and up to a quarter of the shape's inner radius, counts as touching: a cast that moves away or along
  /// the surface misses it. A deeper overlap is inside.
  std::optional<ShapeCastHit<S>> cast_shape(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                                            QueryFilter filter = {}) const;
  void cast_shape_all(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                      std::vector<ShapeCastHit<S>>& out, QueryFilter filter = {}) const;
  std::size_t cast_shape_all(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                             std::span<ShapeCastHit<S>> out, QueryFilter filter = {}) const;
  /// Casts many at once, on the world's threads, with the hits of single casts. `hits` holds one or more for each cast,
  /// equally many: the nearest ones, in order, then hits without a body. Returns false if at least one was refused,
  /// which has no hits; the fault is that of the first. Allocates nothing.
  bool cast_rays(std::span<const RayCast<S>> rays, std::span<RayCastHit<S>> hits) const;
  bool cast_shapes(std::span<const ShapeCast<S>> casts, std::span<ShapeCastHit<S>> hits) const;
  std::optional<ClosestBody<S>> closest_point(Vec3<S> point, S max_distance, QueryFilter filter = {}) const;
  /// Appends the bodies that overlap the shape at the pose to `out`, ascending by slot.
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                     QueryFilter filter = {}) const;
  /// Appends child and triangle as well: of every body, or of every child or triangle (QueryFilter::per).
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                     QueryFilter filter = {}) const;
  /// Returns the first overlap. Allocates nothing.
  std::optional<OverlapHit> overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                          QueryFilter filter = {}) const;
  /// Appends the bodies whose bounds, with the broad phase's margin of 0.1 m at most, meet the box to `out`, ascending
  /// by slot. A cheap first query. Allocates nothing but room in `out`, and scratch memory if it finds more than 32.
  void overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter = {}) const;
  BodyView<S> view(BodyId body) const;

  // Time.
  StepReport step(const StageObserver& observer = {});
  /// Remembers the last `steps` steps, for who rolls back: a step of a tick that is remembered, as after a load, steps
  /// the bodies that differ from then and what those may touch, and takes all others from memory. Never changes a bit
  /// of state, events or report. 0, the default: nothing. A remembered step takes the memory of two snapshots. A step
  /// with an observer or a trace is whole.
  void remember_steps(std::uint32_t steps);
  /// Counts what that has spared, since the last call of remember_steps.
  Resimulation resimulation() const;
  const Events<S>& events() const;
  /// Appends to `out` the points of Events::contacts that belong to one body, in their order. These are those of a body
  /// with a ContactReport, or of a body that touches one.
  void contacts_of(BodyId body, std::vector<ContactPoint<S>>& out) const;
  /// Returns the poses of all moving bodies, interpolated between the last two steps with alpha in 0..1.
  const std::vector<RenderPose>& poses_float(float alpha);

 private:
  using Base::engine_;
};

#define ISO_WORLD_OF(extern, S)              \
  extern template class WorldBase<World<S>>; \
  extern template class World<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_WORLD_OF)

}  // namespace isostep
