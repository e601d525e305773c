// Bodies of world.hpp: the facade over WorldEngine, and the recording of commands.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/scalar/environment.hpp"
#include "isostep/state/world_base.inl"
#include "isostep/store/state_loader.inl"
#include "isostep/world/engine.hpp"
#include "isostep/world/engine_state.inl"
#include "isostep/world/world_joints.inl"
#include "isostep/world/world_queries.inl"

namespace isostep {

template <class S> bool World<S>::use_simd(Simd simd) {
  const ExclusiveCall call = engine_->desk_.enter("use_simd");
  if (!call.allowed()) return false;
  return engine_->tools_.use_simd(simd);
}
template <class S> bool World<S>::use_broad_phase(BroadPhaseName name) {
  const ExclusiveCall call = engine_->desk_.enter("use_broad_phase");
  if (!call.allowed() || static_cast<std::uint32_t>(name) >= kBroadPhases) return false;
  if (const char* instead = expected_instead_of(name))
    return engine_->desk_.faults.refuse_call("use_broad_phase", {Fault::bad_argument, "", "name", instead});
  if (name != broad_phase()) pin_floats([&] { engine_->proxies_.use(name); });
  return true;
}
template <class S> BroadPhaseName World<S>::broad_phase() const { return engine_->proxies_.boxes().name(); }
template <class S> const char* World<S>::simd_name() const { return engine_->tools_.contact_kernels->name; }
template <class S> void World<S>::use_threads(const TaskRunner& runner) {
  const ExclusiveCall call = engine_->desk_.enter("use_threads");
  if (!call.allowed()) return;
  engine_->tools_.runner = runner;
  engine_->tools_.runner.threads = clamp(runner.threads, std::int32_t{1}, static_cast<std::int32_t>(kMaxPieces));
}
template <class S> void World<S>::use_assets(const AssetSource& assets) {
  const ExclusiveCall call = engine_->desk_.enter("use_assets");
  if (call.allowed()) engine_->assets_ = assets;
}

#define ISO_APPLY(name, Type, Result, S)                           \
  template <class S> Result World<S>::apply(const Type& command) { \
    return engine_->desk_.run(#name, engine_->commands_, command); \
  }
ISO_FOR_EACH_COMMAND(ISO_APPLY, S)
#undef ISO_APPLY

namespace detail {
template <class S, class Shape> ShapeId add_one(World<S>& world, const Shape& shape) {
  const Child<S> child = {primitive_of(shape), Pose<S>::identity()};
  return world.add_shape(std::span<const Child<S>>(&child, 1));
}
}  // namespace detail

// Literals become numbers here and not in the caller's code, which may round as it likes.
#define ISO_ADD_SHAPE(name, Shape)                                                                                \
  template <class S> ShapeId World<S>::add_shape(const Shape<S>& shape) { return detail::add_one(*this, shape); } \
  template <class S> ShapeId World<S>::add_shape(const Shape<Literal>& shape) {                                   \
    return pin_floats([&] { return detail::add_one(*this, Shape<S>::of(shape)); });                               \
  }
ISO_FOR_EACH_SHAPE(ISO_ADD_SHAPE)
#undef ISO_ADD_SHAPE
template <class S> ShapeId World<S>::add_shape(const BlobRef& blob) {
  Child<S> child = {Primitive<S>{}, Pose<S>::identity()};
  child.primitive.type = blob == nullptr ? ShapeType{} : blob->type();
  child.primitive.blob = 1;
  return add_shape(std::span<const Child<S>>(&child, 1), std::span<const BlobRef>(&blob, 1));
}
/// Leaves out the content of a blob that the world already has, so that a recording holds it once.
template <class S> ShapeId World<S>::add_shape(std::span<const Child<S>> children, std::span<const BlobRef> blobs) {
  AddShape<S> command = {{children.begin(), children.end()}};
  for (const BlobRef& blob : blobs) {
    if (blob == nullptr) {
      engine_->desk_.faults.refuse_call("add_shape", {Fault::bad_shape, "", "blobs", "none that is null"});
      return {};
    }
    const bool known = engine_->state_.geometry->find(blob->id()) != GeometryStore::kNone;
    command.blobs.push_back({blob->id(), known ? nullptr : blob});
  }
  return apply(command);
}
#define ISO_RECORD(name, Record, Id, S)                                                                  \
  template <class S> Id World<S>::add(const Record& record) { return apply(AddRecord<Record>{record}); } \
  template <class S> bool World<S>::set(Id id, const Record& record) {                                   \
    return apply(SetRecordOf<Record>{id, record});                                                       \
  }                                                                                                      \
  template <class S> bool World<S>::remove(Id id) { return apply(RemoveRecord<Id>{id}); }                \
  template <class S> const Record* World<S>::find(Id id) const {                                         \
    return detail::registry_of(*engine_->state_.records, id).find(id);                                   \
  }
ISO_FOR_EACH_RECORD(ISO_RECORD, S)
#undef ISO_RECORD
#define ISO_INPUT(name, Input, Id, S)                                           \
  template <class S> bool World<S>::set_input(Id id, const Input& input) {      \
    return apply(SetInputOf<Input>{id, input});                                 \
  }                                                                             \
  template <class S> const Input* World<S>::input(Id id) const {                \
    const WorldState<S>& state = engine_->state_;                               \
    return find(id) == nullptr ? nullptr : &state.parts.name##_inputs[id.slot]; \
  }
ISO_FOR_EACH_INPUT(ISO_INPUT, S)
#undef ISO_INPUT
template <class S> bool World<S>::set_spin(WheelId wheel, S spin) { return apply(SetWheelSpin<S>{wheel, spin}); }
#define ISO_STATE(name, State, Id, S)                                           \
  template <class S> const State* World<S>::state(Id id) const {                \
    const WorldState<S>& state = engine_->state_;                               \
    return find(id) == nullptr ? nullptr : &state.parts.name##_states[id.slot]; \
  }
ISO_FOR_EACH_RECORD_STATE(ISO_STATE, S)
#undef ISO_STATE
template <class S> bool World<S>::remove_shape(ShapeId shape) { return apply(RemoveShape{shape}); }
template <class S> bool World<S>::set_heights(ShapeId shape, std::uint32_t child, const HeightPatch& patch) {
  return apply(SetHeights{shape,
                          child,
                          patch.column,
                          patch.row,
                          patch.columns,
                          patch.rows,
                          {patch.heights.begin(), patch.heights.end()},
                          {patch.materials.begin(), patch.materials.end()}});
}
template <class S> const BakedHeightField* World<S>::height_field(ShapeId shape, std::uint32_t child) const {
  if (!contains(shape)) return nullptr;
  const Child<S>* const field = engine_->map_.shapes.height_field_of(shape.slot, child);
  if (field == nullptr) return nullptr;
  return &shape_as<HeightField>(engine_->map_.shapes.contents().view(field->primitive)).surface();
}
template <class S> BodyId World<S>::create(const BodyDefinition<S>& definition) {
  return apply(CreateBody<S>{definition});
}
template <class S> bool World<S>::destroy(BodyId body) { return apply(DestroyBody{body}); }
template <class S> std::size_t World<S>::destroy(std::span<const BodyId> bodies) {
  const ExclusiveCall call = engine_->desk_.enter("destroy");
  if (!call.allowed()) return 0;
  engine_->desk_.faults.clear();
  return pin_floats([&] { return engine_->commands_.destroy_all(bodies); });
}
template <class S> bool World<S>::wake(BodyId body) { return apply(WakeBody{body}); }
template <class S> bool World<S>::set_pose(BodyId body, const Pose<S>& pose) { return apply(SetPose<S>{body, pose}); }
template <class S> bool World<S>::set_velocity(BodyId body, Vec3<S> linear, Vec3<S> angular) {
  return apply(SetVelocity<S>{body, linear, angular});
}
template <class S> bool World<S>::set_material(BodyId body, const Material<S>& material) {
  return apply(SetMaterial<S>{body, material});
}
template <class S> bool World<S>::set_filter(BodyId body, const Filter& filter) {
  return apply(SetFilter{body, filter});
}
template <class S>
bool World<S>::set_motion(BodyId body, S gravity_scale, S linear_damping, S angular_damping, std::uint32_t locks) {
  return apply(SetMotion<S>{body, gravity_scale, linear_damping, angular_damping, locks});
}
template <class S> bool World<S>::set_user_data(BodyId body, std::uint64_t user_data) {
  return apply(SetUserData{body, user_data});
}
template <class S> bool World<S>::set_enabled(BodyId body, bool enabled) {
  return apply(SetEnabled{body, enabled ? 1u : 0u});
}
template <class S> bool World<S>::set_type(BodyId body, BodyType type, const BodyMass<S>& mass) {
  return apply(SetType<S>{body, type, mass});
}
template <class S> bool World<S>::set_shape(BodyId body, ShapeId shape) {
  BodyMass<S> mass;
  mass.mass = this->mass(body);
  return apply(SetShape<S>{body, shape, mass});
}
template <class S> bool World<S>::set_shape(BodyId body, ShapeId shape, const BodyMass<S>& mass) {
  return apply(SetShape<S>{body, shape, mass});
}
template <class S> bool World<S>::set_mass(BodyId body, const BodyMass<S>& mass) {
  return apply(SetMass<S>{body, mass});
}
template <class S> bool World<S>::sleep(BodyId body) { return apply(SleepBody{body}); }
template <class S> bool World<S>::move_to(BodyId body, const Pose<S>& pose) { return apply(MoveTo<S>{body, pose}); }
template <class S> bool World<S>::set_gravity(Vec3<S> gravity) { return apply(SetGravity<S>{gravity}); }
template <class S> bool World<S>::apply_force(BodyId body, Vec3<S> force, Vec3<S> torque) {
  return apply(ApplyForce<S>{body, force, torque});
}
template <class S> bool World<S>::apply_force_at(BodyId body, Vec3<S> force, Vec3<S> point) {
  return pin_floats([&]() -> bool {
    if (!engine_->desk_.faults.accept_call("apply_force_at", detail::fault_of_place(point, "point"))) return false;
    return apply_force(body, force, detail::saturated_cross(point - center_of_mass(body), force));
  });
}
template <class S> bool World<S>::apply_impulse(BodyId body, Vec3<S> impulse, Vec3<S> angular_impulse) {
  return apply(ApplyImpulse<S>{body, impulse, angular_impulse});
}
template <class S> bool World<S>::apply_impulse_at(BodyId body, Vec3<S> impulse, Vec3<S> point) {
  return pin_floats([&]() -> bool {
    if (!engine_->desk_.faults.accept_call("apply_impulse_at", detail::fault_of_place(point, "point"))) return false;
    return apply_impulse(body, impulse, detail::saturated_cross(point - center_of_mass(body), impulse));
  });
}

template <class S> bool World<S>::contains(BodyId body) const { return engine_->state_.body_slots.holds(body); }
template <class S> bool World<S>::contains(ShapeId shape) const { return engine_->state_.shape_slots.holds(shape); }
template <class S> bool World<S>::contains(JointId joint) const { return engine_->state_.joint_slots.holds(joint); }
template <class S> bool World<S>::is_enabled(BodyId body) const {
  return contains(body) && engine_->map_.is_enabled(body.slot);
}
template <class S> bool World<S>::is_awake(BodyId body) const {
  return contains(body) && engine_->map_.location(body.slot).set == Location::kAwake;
}
template <class S> BodyType World<S>::type(BodyId body) const {
  const BodyProperties<S>* properties = engine_->map_.properties_of(body);
  return properties == nullptr ? BodyType::static_ : properties->type;
}
template <class S> Pose<S> World<S>::pose(BodyId body) const {
  return pin_floats([&]() -> Pose<S> {
    if (!contains(body)) return Pose<S>::identity();
    return origin_pose(*engine_->map_.state_of(body), *engine_->map_.properties_of(body));
  });
}
template <class S> Vec3<S> World<S>::center_of_mass(BodyId body) const {
  const BodyState<S>* state = engine_->map_.state_of(body);
  return state == nullptr ? Vec3<S>::zero() : state->centre;
}
template <class S> Vec3<S> World<S>::velocity(BodyId body) const {
  const BodyState<S>* state = engine_->map_.state_of(body);
  return state == nullptr ? Vec3<S>::zero() : convert<S>(state->velocity);
}
template <class S> Vec3<S> World<S>::angular_velocity(BodyId body) const {
  const BodyState<S>* state = engine_->map_.state_of(body);
  return state == nullptr ? Vec3<S>::zero() : convert<S>(state->angular_velocity);
}
template <class S> Vec3<S> World<S>::velocity_at(BodyId body, Vec3<S> point) const {
  return pin_floats([&]() -> Vec3<S> {
    const BodyState<S>* state = engine_->map_.state_of(body);
    if (state == nullptr) return Vec3<S>::zero();
    return velocity(body) + detail::saturated_cross(angular_velocity(body), point - state->centre);
  });
}
template <class S> S World<S>::mass(BodyId body) const {
  const BodyProperties<S>* properties = engine_->map_.properties_of(body);
  return properties == nullptr ? S(0) : properties->mass;
}
template <class S> S World<S>::inertia(BodyId body, Vec3<Unit<S>> axis) const {
  return pin_floats([&]() -> S {
    const BodyProperties<S>* properties = engine_->map_.properties_of(body);
    if (properties == nullptr) return S(0);
    const Quat<Unit<S>> principal = pose(body).orientation * properties->principal;
    const Vec3<S> along = convert<S>(transposed_times(to_matrix(principal), axis));
    S sum = S(0);
    for (int i = 0; i < 3; ++i) {
      if (!(S(0) < properties->kappa[i])) continue;
      const S of_axis = divide_to<S>(properties->mass, properties->kappa[i]);
      sum = saturating_add(sum, along[i] * along[i] * of_axis);
    }
    return sum;
  });
}
template <class S> std::uint64_t World<S>::user_data(BodyId body) const {
  const BodyProperties<S>* properties = engine_->map_.properties_of(body);
  return properties == nullptr ? 0 : properties->user_data;
}
template <class S> std::vector<BodyId> World<S>::bodies() const {
  return engine_->state_.body_slots.template ids<BodyId>();
}
template <class S> std::vector<JointId> World<S>::joints() const {
  return engine_->state_.joint_slots.template ids<JointId>();
}
template <class S> WorldCounts World<S>::counts() const {
  const WorldState<S>& state = engine_->state_;
  WorldCounts counts = {};
  counts.static_bodies = static_cast<std::uint32_t>(state.static_bodies.size());
  counts.awake = static_cast<std::uint32_t>(state.awake.states.size());
  counts.contacts = static_cast<std::uint32_t>(state.contacts.size());
  for (const Contact<S>& contact : state.contacts) counts.points += contact.count;
  for (const auto& island : state.sleeping) {
    counts.asleep += static_cast<std::uint32_t>(island->bodies.states.size());
    counts.contacts += static_cast<std::uint32_t>(island->contacts.size());
    for (const Contact<S>& contact : island->contacts) counts.points += contact.count;
    counts.joints += static_cast<std::uint32_t>(island->joints.states.size());
  }
  counts.joints += static_cast<std::uint32_t>(state.joints.states.size());
  counts.bodies = counts.static_bodies + counts.awake + counts.asleep;
  counts.shapes = state.shape_slots.count_taken();
  return counts;
}

template <class S> BodyView<S> World<S>::view(BodyId body) const {
  if (!contains(body)) return {};
  return pin_floats([&]() -> BodyView<S> {
    const BodyState<S>* state = engine_->map_.state_of(body);
    const BodyProperties<S>* properties = engine_->map_.properties_of(body);
    return {state, properties, engine_->map_.shapes.children_of(properties->shape), engine_->map_.shapes.contents(),
            origin_pose(*state, *properties)};
  });
}

template <class S> StepReport World<S>::step(const StageObserver& observer) {
  const ExclusiveCall call = engine_->desk_.enter("step");
  if (!call.allowed()) return {};
  engine_->desk_.journal.record_step();
  return pin_floats([&] { return engine_->step(observer); });
}
template <class S> void World<S>::remember_steps(std::uint32_t steps) {
  const ExclusiveCall call = engine_->desk_.enter("remember_steps");
  if (!call.allowed()) return;
  if (steps == 0) return engine_->memory_.reset();
  if (engine_->memory_ == nullptr) engine_->memory_ = std::make_unique<StepMemory<S>>(*engine_);
  engine_->memory_->resize(steps);
}
template <class S> Resimulation World<S>::resimulation() const {
  return engine_->memory_ == nullptr ? Resimulation{} : engine_->memory_->totals();
}
template <class S> void World<S>::contacts_of(BodyId body, std::vector<ContactPoint<S>>& out) const {
  for (const ContactPoint<S>& point : engine_->events_.contacts) {
    if (point.a == body || point.b == body) out.push_back(point);
  }
}
template <class S> const Events<S>& World<S>::events() const { return engine_->events_; }
template <class S> const std::vector<RenderPose>& World<S>::poses_float(float alpha) {
  return *pin_floats([&] { return &engine_->render_poses_.fill(alpha); });
}

}  // namespace isostep

/// Instantiates World<S> and the loading of states. Rest: executing_commands.inl, world_queries.inl, engine_step.inl.
#define ISO_INSTANTIATE_WORLD(S)                       \
  ISO_STATE_LOADER_OF(, S)                             \
  template std::uint64_t WorldEngine<S>::hash() const; \
  ISO_WORLD_OF(, S)
