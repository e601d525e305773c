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
/// Mutators act at once, between steps; a refused one returns false or a null id, changes nothing and leaves its reason
/// in `fault()`. Observers of stages call none. One thread at a time calls mutators and `step`; between them any number
/// may query. Two worlds of one type that were given the same calls in the same order have equal hashes at every
/// tick, on every machine. `load(save(w))` brings back ids, contacts, sleep and future exactly.
///
/// A game is no World but has one, beside what it remembers itself: see Composite (state/composite.hpp).
///
/// Frames: right-handed, world axes fixed, y up by the default gravity. Units: kg, m, s, rad.
template <class S> class World final : public WorldBase<World<S>> {
  ISO_REQUIRE_ENGINE(S);
  using Base = WorldBase<World<S>>;

 public:
  using Scalar = S;
  using EveryCommand = isostep::EveryCommand<S>;

  /// Settings out of range are brought into it, and that is a fault. So is a solver that the build leaves out
  /// (ISOSTEP_BOOK): the world has soft_step then.
  explicit World(const Settings<S>& settings = {}) : Base(settings) {}

  /// Sets the solver's lanes. Never changes a bit; false and no change where this processor or build lacks them.
  bool use_simd(Simd simd);
  const char* simd_name() const;
  /// Sets the structure that finds bodies near each other, for steps and queries: the tree of boxes unless told. Never
  /// changes a bit. Grids move and insert more quickly, the tree finds pairs more quickly. One that the build leaves
  /// out (ISOSTEP_BOOK) is refused.
  bool use_broad_phase(BroadPhaseName name);
  BroadPhaseName broad_phase() const;
  /// Sets threads that help with every step from now on; none by default. Never changes a bit. Small worlds stay on the
  /// calling thread. What `runner` points to outlives the world or the next call.
  void use_threads(const TaskRunner& runner);
  /// Sets the source of the blobs that states and commands name and do not carry: BlobHome::asset. None by default.
  void use_assets(const AssetSource& assets);

  // Shapes are shared by the bodies that name them. add_shape takes any of the list, with the world's numbers, or
  // without a scalar: Box{{0.5, 0.5, 0.5}}.
#define ISO_ADD_SHAPE(name, Shape)          \
  ShapeId add_shape(const Shape<S>& shape); \
  ShapeId add_shape(const Shape<Literal>& shape);
  ISO_FOR_EACH_SHAPE(ISO_ADD_SHAPE)
#undef ISO_ADD_SHAPE
  /// Adds the shape that a blob is by itself: a hull.
  ShapeId add_shape(const BlobRef& blob);
  /// Adds a shape of children, which name `blobs` by Primitive::blob: 1 + the index here.
  ShapeId add_shape(std::span<const Child<S>> children, std::span<const BlobRef> blobs = {});
  bool remove_shape(ShapeId shape);
  /// Sets other heights, and materials, for a part of the field that is that child of the shape.
  bool set_heights(ShapeId shape, std::uint32_t child, const HeightPatch& patch);
  /// Returns the field as it is until the next command or load; null: the child is no height field.
  const BakedHeightField* height_field(ShapeId shape, std::uint32_t child = 0) const;

  // Bodies.
  BodyId create(const BodyDefinition<S>& definition);
  bool destroy(BodyId body);
  /// Destroys bodies as if one by one, in this order, at the price of one: a pass over the awake. Returns how many.
  std::size_t destroy(std::span<const BodyId> bodies);
  bool wake(BodyId body);
  bool set_pose(BodyId body, const Pose<S>& pose);
  bool set_velocity(BodyId body, Vec3<S> linear, Vec3<S> angular);
  bool set_material(BodyId body, const Material<S>& material);
  bool set_filter(BodyId body, const Filter& filter);
  bool set_motion(BodyId body, S gravity_scale, S linear_damping, S angular_damping, std::uint32_t locks);
  bool set_user_data(BodyId body, std::uint64_t user_data);
  /// Takes a body out, or brings it back. A disabled body keeps its id, pose, velocity, joints and records, but does
  /// not move, touches nothing, is found by no query and seen by no sensor; its joints, couplings and springs hold
  /// nothing, its other records do nothing. What it touched ends at once and wakes. Pose, mass, type, material and
  /// filter may be set meanwhile; what moves it is refused. It comes back as it was, awake. To be what it is already
  /// changes nothing.
  bool set_enabled(BodyId body, bool enabled);
  /// Changes the type of a body, with id, shape, joints and records. `mass` is that of a body that becomes dynamic.
  /// Velocity stays, but of a body that becomes static; contacts end and begin anew. A joint without a dynamic body
  /// holds nothing. Refused: a dynamic body of a shape without a volume, a type that a record of the body may not name,
  /// a body too light for its joints.
  bool set_type(BodyId body, BodyType type, const BodyMass<S>& mass = {});
  /// Sets mass and inertia of a dynamic body, as if it had been made with them. Velocity stays. Forces of this step
  /// that were applied before act as on the old mass.
  bool set_mass(BodyId body, const BodyMass<S>& mass);
  /// Changes the shape of a body: growth, crouching, damage. Id, origin's pose, velocity, joints and records stay;
  /// contacts end and begin anew, and what overlaps then is pushed apart. Without a mass a dynamic body keeps its own,
  /// with the inertia of the shape. Refused: a shape without a volume for a dynamic body, one that a record or joint of
  /// the body may not have.
  bool set_shape(BodyId body, ShapeId shape);
  bool set_shape(BodyId body, ShapeId shape, const BodyMass<S>& mass);
  /// Puts a dynamic body and all that touches it or is tied to it to sleep at once: they stop, and lose what was asked
  /// of them for the next step, which lists them in `fell_asleep`. Refused where one of them may not sleep, or the
  /// world's settings forbid it. What moves and touches them wakes them, in the next step if it does so now.
  bool sleep(BodyId body);
  /// The next step carries a kinematic body to that pose. In that step it has the velocity that leads there, along a
  /// line and about one axis by the shorter way, so that it pushes and carries what it touches, and is held by no lock;
  /// as the step ends it lies exactly at the pose, and stands still. What is further than a body may move in a step,
  /// Limits::speed() and a radian a sub-step, is not reached: the body goes as far, and stops there. A velocity that
  /// was set is of no account. Once more before the step is another pose in place of the first. A disabled body goes
  /// when it is enabled again.
  bool move_to(BodyId body, const Pose<S>& pose);
  bool set_gravity(Vec3<S> gravity);  // [m/s^2] world
  /// Adds a force [N] and a torque [N m], world, for the length of the next step. A point is in the world [m].
  bool apply_force(BodyId body, Vec3<S> force, Vec3<S> torque = {S(0), S(0), S(0)});
  bool apply_force_at(BodyId body, Vec3<S> force, Vec3<S> point);
  /// Applies an impulse [kg m/s] and an angular impulse [kg m^2/s], world: velocities change at once.
  bool apply_impulse(BodyId body, Vec3<S> impulse, Vec3<S> angular_impulse = {S(0), S(0), S(0)});
  bool apply_impulse_at(BodyId body, Vec3<S> impulse, Vec3<S> point);

  // Joints.
  /// A joint whose frames lie where `frame` (world, a unit quaternion) is now; a null id is the world. Add limits,
  /// motor, spring; then create.
  JointProperties<S> joint_at(JointType type, BodyId a, BodyId b, const Pose<S>& frame) const;
  /// A joint of two frames that lie apart.
  JointProperties<S> joint_between(JointType type, BodyId a, const Pose<S>& frame_a, BodyId b,
                                   const Pose<S>& frame_b) const;
  JointId create(const JointProperties<S>& joint);
  /// Creates one of joint_presets.hpp, with its AxisDrives: all of it or, with a fault, nothing.
  JointId create(const JointDefinition<S>& joint);
  bool destroy(JointId joint);
  bool set_joint(JointId joint, const JointProperties<S>& properties);
  /// Sets a part of it, along joint_position(); set_joint has the rest. Six-axis joints have AxisDrives instead.
  bool set_limits(JointId joint, S lower, S upper);        // [rad] or [m]
  bool set_motor(JointId joint, S speed, S max_force);     // [rad/s], [N m] or [m/s], [N]; max_force 0: no motor
  bool set_spring(JointId joint, S frequency, S damping);  // [Hz], [1] 1 is critical; frequency 0: no spring
  bool set_target(JointId joint, S target);                // [rad] or [m] that the spring pulls to
  const JointProperties<S>* joint(JointId joint) const;
  /// Distance between the joint's anchors, or for a distance joint its error [m]; 0 for a stale id.
  S joint_error(JointId joint) const;
  /// The position that lower, upper and spring_target count: the twist of frame b against a about z in (-pi, pi] [rad];
  /// of a slider or cylindrical joint the way along z of a, of a distance joint the length [m]. 0 for a stale id.
  S joint_position(JointId joint) const;
  /// The position of one axis of a six-axis joint: its way [m], or its angle in (-pi, pi] [rad].
  S joint_position(JointId joint, JointAxis axis) const;
  /// The record on one axis of a six-axis joint, presets and ragdolls included: for find, set and remove, as to change
  /// the target of a servo or the speed of a motor. Null where there is none.
  AxisDriveId axis_drive(JointId joint, JointAxis axis) const;

  // Records: each kind of record_list.hpp. They act on what is awake; adding one, changing or removing it wakes what it
  // acts on. They go with the bodies and joints that they name.
#define ISO_RECORD(name, Record, Id, S)                      \
  Id add(const Record& record);                              \
  bool set(Id id, const Record& record);                     \
  bool remove(Id id);                                        \
  /* Null for a stale id; until the next command or load. */ \
  const Record* find(Id id) const;
  ISO_FOR_EACH_RECORD(ISO_RECORD, S)
#undef ISO_RECORD
  /// The input that a game gives a record, until it gives another; a new record has its default. Null: a stale id.
#define ISO_INPUT(name, Input, Id, S)        \
  bool set_input(Id id, const Input& input); \
  const Input* input(Id id) const;
  ISO_FOR_EACH_INPUT(ISO_INPUT, S)
#undef ISO_INPUT
  /// Sets the spin [rad/s] of a wheel from now on: of a car that is put on the road at speed.
  bool set_spin(WheelId wheel, S spin);
  using Base::state;
  /// The state in which the last step left a record. Null: a stale id.
#define ISO_STATE(name, State, Id, S) const State* state(Id id) const;
  ISO_FOR_EACH_RECORD_STATE(ISO_STATE, S)
#undef ISO_STATE

  /// Every mutator above is one of these with its fields as arguments: command.hpp.
#define ISO_APPLY(name, Type, Result, S) Result apply(const Type& command);
  ISO_FOR_EACH_COMMAND(ISO_APPLY, S)
#undef ISO_APPLY

  // Getters of bodies. A stale id gives the zero of the type that is returned.
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
  /// The velocity [m/s] of a point [m] that moves with the body, both world.
  Vec3<S> velocity_at(BodyId body, Vec3<S> point) const;
  S mass(BodyId body) const;
  /// The inertia [kg m^2] about an axis [1] through the centre of mass, world. 0: not dynamic, or a locked axis.
  S inertia(BodyId body, Vec3<Unit<S>> axis) const;
  std::uint64_t user_data(BodyId body) const;
  std::vector<BodyId> bodies() const;
  std::vector<JointId> joints() const;
  WorldCounts counts() const;

  // Queries, as of the last step or command. QueryFilter (query_types.hpp) says what they see. Their answers are a
  // function of the state: a world that loads a snapshot gives those of the world that saved it.
  /// The first hit.
  std::optional<RayCastHit<S>> cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter = {}) const;
  /// The first hit of every body on the way, or of every child or triangle, in order, appended to `out`.
  void cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                    QueryFilter filter = {}) const;
  /// Writes the nearest that `out` has room for, in order, and returns their number. Allocates nothing.
  std::size_t cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::span<RayCastHit<S>> out,
                           QueryFilter filter = {}) const;
  /// The first hit of a convex shape that moves from a pose along a translation without turning. Overlaps of up to
  /// 1/64 m at the start, and up to a quarter of the shape's inner radius, are touch: what touches and moves away or
  /// along misses. Deeper is inside.
  std::optional<ShapeCastHit<S>> cast_shape(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                                            QueryFilter filter = {}) const;
  void cast_shape_all(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                      std::vector<ShapeCastHit<S>>& out, QueryFilter filter = {}) const;
  std::size_t cast_shape_all(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                             std::span<ShapeCastHit<S>> out, QueryFilter filter = {}) const;
  /// Casts many at once, on the world's threads; the hits are those of one by one, whatever their number. `hits` has
  /// room for the same number of hits for each, one or more: the nearest ones, in order, then some without a body.
  /// False: at least one was refused, and has no hits; the fault is that of the first. Allocates nothing.
  bool cast_rays(std::span<const RayCast<S>> rays, std::span<RayCastHit<S>> hits) const;
  bool cast_shapes(std::span<const ShapeCast<S>> casts, std::span<ShapeCastHit<S>> hits) const;
  std::optional<ClosestBody<S>> closest_point(Vec3<S> point, S max_distance, QueryFilter filter = {}) const;
  /// Bodies that overlap the shape at the pose, ascending by slot, appended to `out`.
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                     QueryFilter filter = {}) const;
  /// Appends the child and triangle of each as well: of every body, or of every child or triangle.
  void overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                     QueryFilter filter = {}) const;
  /// The first of them. Allocates nothing.
  std::optional<OverlapHit> overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                          QueryFilter filter = {}) const;
  /// Bodies whose bounds, with the broad phase's margin of 0.1 m at most, meet the box, ascending by slot, appended to
  /// `out`. A cheap first query: allocates nothing but room in `out`, and where more than 32 are found.
  void overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter = {}) const;
  BodyView<S> view(BodyId body) const;

  // Time.
  StepReport step(const StageObserver& observer = {});
  const Events<S>& events() const;
  /// Appends to `out` those of Events::contacts that are of one body, in their order: of a body with a ContactReport,
  /// or of one that touches such a body.
  void contacts_of(BodyId body, std::vector<ContactPoint<S>>& out) const;
  /// Poses of all moving bodies between the last step and the one before it, alpha in 0..1.
  const std::vector<RenderPose>& poses_float(float alpha);

 private:
  using Base::engine_;
};

#define ISO_WORLD_OF(extern, S)              \
  extern template class WorldBase<World<S>>; \
  extern template class World<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_WORLD_OF)

}  // namespace isostep
