// Bodies: made, asked and changed.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

/// A call that changes a body: work(WorldOf<S>&, BodyId).
template <class Work> iso_status change_body(iso_world* world, const char* call, iso_body body, const Work& work) {
  return in_any_world(world, call, Access::changes, [&](auto& of) {
    work(of.world, id_of<BodyId>(body));
    return kOk;
  });
}

template <class S> Vec3<S> vec3_at(const void* from) {
  Vec3<S> v = Vec3<S>::zero();
  if (from != nullptr) take_at(static_cast<const std::uint8_t*>(from), v);
  return v;
}

template <class S> iso_status body_create(iso_world* world, const void* from, iso_body* out) {
  constexpr const char* kCall = "body_create";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(kCall, out);
    BodyDefinition<S> definition;
    const iso_status taken = take_sized(kCall, from, definition);
    return taken != kOk ? taken : put_id(of.world.create(definition), out);
  });
}

/// Refuses a stale id in the world's words.
iso_status stale(const char* call) { return refuse({Fault::stale_id, call, "body", "a body of this world"}); }

template <class S> CBodyState<S> state_of(const World<S>& world, BodyId id) {
  CBodyState<S> state;
  state.pose = world.pose(id);
  state.centre = world.center_of_mass(id);
  state.velocity = world.velocity(id);
  state.angular_velocity = world.angular_velocity(id);
  state.user_data = world.user_data(id);
  state.type = world.type(id);
  state.awake = world.is_awake(id);
  state.enabled = world.is_enabled(id);
  return state;
}

template <class S> iso_status get_state(const iso_world* world, iso_body body, void* out) {
  constexpr const char* kCall = "body_get_state";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    const BodyId id = id_of<BodyId>(body);
    return of.world.contains(id) ? put_sized(kCall, out, state_of(of.world, id)) : stale(kCall);
  });
}

std::uint32_t size_at(const std::uint8_t* sized) {
  std::uint32_t size = 0;
  std::memcpy(&size, sized, sizeof size);
  return size;
}

template <class S> iso_status get_states(const iso_world* world, const iso_body* bodies, std::size_t count, void* out) {
  constexpr const char* kCall = "bodies_get_states";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    if (count == 0) return kOk;
    ISO_C_REQUIRE(kCall, bodies);
    ISO_C_REQUIRE(kCall, out);
    auto* const bytes = static_cast<std::uint8_t*>(out);
    const std::uint32_t size = size_at(bytes);
    for (std::size_t i = 0; i < count; ++i) {  // before anything is written
      if (!of.world.contains(id_of<BodyId>(bodies[i]))) return stale(kCall);
      if (size < kHeadSize || size_at(bytes + i * size) != size) return refuse(ISO_WRONG_SIZE, kCall, "out");
    }
    for (std::size_t i = 0; i < count; ++i) {
      const iso_status put = put_sized(kCall, bytes + i * size, state_of(of.world, id_of<BodyId>(bodies[i])));
      if (put != kOk) return put;
    }
    return kOk;
  });
}

template <class S> iso_status get_properties(const iso_world* world, iso_body body, void* out) {
  constexpr const char* kCall = "body_get_properties";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    const auto view = of.world.view(id_of<BodyId>(body));
    if (view.state == nullptr) return stale(kCall);
    const BodyProperties<S>& from = *view.properties;
    CBodyProperties<S> told;
    told.type = from.type;
    told.flags = from.flags;
    told.filter = from.filter;
    told.user_data = from.user_data;
    told.mass = from.mass;
    told.local_centre = from.local_centre;
    told.material = from.material;
    told.gravity_scale = from.gravity_scale;
    told.linear_damping = from.linear_damping;
    told.angular_damping = from.angular_damping;
    return put_sized(kCall, out, told);
  });
}

template <class S>
iso_status get_children(const iso_world* world, iso_body body, void* out, std::size_t room, std::size_t* count) {
  constexpr const char* kCall = "body_get_children";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    const auto view = of.world.view(id_of<BodyId>(body));
    if (view.state == nullptr) return stale(kCall);
    const std::vector<Child<S>> children(view.children.begin(), view.children.end());
    return put_list(kCall, children, out, room, count);
  });
}

template <class S> iso_status get_velocity_at(const iso_world* world, iso_body body, const void* point, void* out) {
  constexpr const char* kCall = "body_get_velocity_at";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    ISO_C_REQUIRE(kCall, point);
    ISO_C_REQUIRE(kCall, out);
    if (!of.world.contains(id_of<BodyId>(body))) return stale(kCall);
    put_plain(out, of.world.velocity_at(id_of<BodyId>(body), vec3_at<S>(point)));
    return kOk;
  });
}
template <class S> iso_status get_inertia(const iso_world* world, iso_body body, const void* axis, void* out) {
  constexpr const char* kCall = "body_get_inertia";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    ISO_C_REQUIRE(kCall, axis);
    ISO_C_REQUIRE(kCall, out);
    if (!of.world.contains(id_of<BodyId>(body))) return stale(kCall);
    put_plain(out, of.world.inertia(id_of<BodyId>(body), vec3_at<Unit<S>>(axis)));
    return kOk;
  });
}

/// A change that takes a plain struct T: work(world, id, value).
template <class S, class T, class Work>
iso_status set_plain(iso_world* world, const char* call, iso_body body, const void* from, const Work& work) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    T value{};
    const iso_status taken = take_plain(call, from, value);
    if (taken == kOk) work(of.world, id_of<BodyId>(body), value);
    return taken;
  });
}
/// A change that takes two vectors; the second may be null where that is said.
template <class S, class Work>
iso_status set_vectors(iso_world* world, const char* call, iso_body body, const void* first, const void* second,
                       bool second_may_be_null, const Work& work) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(call, first);
    if (!second_may_be_null) ISO_C_REQUIRE(call, second);
    work(of.world, id_of<BodyId>(body), vec3_at<S>(first), vec3_at<S>(second));
    return kOk;
  });
}

template <class S, class N>
iso_status set_motion(iso_world* world, iso_body body, const N (&numbers)[3], std::uint32_t locks) {
  return in_world<S>(world, "body_set_motion", Access::changes, [&](auto& of) {
    of.world.set_motion(id_of<BodyId>(body), same_bits<S>(numbers[0]), same_bits<S>(numbers[1]),
                        same_bits<S>(numbers[2]), locks);
    return kOk;
  });
}
template <class S> iso_status set_type(iso_world* world, iso_body body, iso_body_type type, const void* mass) {
  constexpr const char* kCall = "body_set_type";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    if (type >= Enumerators<BodyType>::kCount) return refuse(ISO_BAD_ENUM, kCall, "type");
    BodyMass<S> taken;
    const iso_status status = mass == nullptr ? kOk : take_sized(kCall, mass, taken);
    if (status == kOk) of.world.set_type(id_of<BodyId>(body), static_cast<BodyType>(type), taken);
    return status;
  });
}
template <class S> iso_status set_mass(iso_world* world, iso_body body, const void* mass) {
  constexpr const char* kCall = "body_set_mass";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    BodyMass<S> taken;
    const iso_status status = take_sized(kCall, mass, taken);
    if (status == kOk) of.world.set_mass(id_of<BodyId>(body), taken);
    return status;
  });
}

template <class S> iso_status set_shape(iso_world* world, iso_body body, iso_shape shape, const void* mass) {
  constexpr const char* kCall = "body_set_shape";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    const BodyId id = id_of<BodyId>(body);
    const ShapeId to = id_of<ShapeId>(shape);
    if (mass == nullptr) return of.world.set_shape(id, to), kOk;
    BodyMass<S> taken;
    const iso_status status = take_sized(kCall, mass, taken);
    if (status == kOk) of.world.set_shape(id, to, taken);
    return status;
  });
}

template <class Id> uint8_t exists(const iso_world* world, const char* call, std::uint64_t id) {
  bool there = false;
  in_any_world(world, call, Access::reads, [&](auto& of) {
    there = of.world.contains(id_of<Id>(id));
    return kOk;
  });
  return there ? 1 : 0;
}

}  // namespace

iso_status iso_body_destroy(iso_world* world, iso_body body) {
  return change_body(world, "body_destroy", body, [](auto& w, BodyId id) { w.destroy(id); });
}
iso_status iso_body_wake(iso_world* world, iso_body body) {
  return change_body(world, "body_wake", body, [](auto& w, BodyId id) { w.wake(id); });
}
iso_status iso_body_sleep(iso_world* world, iso_body body) {
  return change_body(world, "body_sleep", body, [](auto& w, BodyId id) { w.sleep(id); });
}
iso_status iso_body_set_enabled(iso_world* world, iso_body body, uint8_t enabled) {
  if (enabled > 1) return refuse(ISO_BAD_ENUM, "body_set_enabled", "enabled");
  return change_body(world, "body_set_enabled", body, [&](auto& w, BodyId id) { w.set_enabled(id, enabled == 1); });
}
iso_status iso_body_set_filter(iso_world* world, iso_body body, const iso_filter* filter) {
  ISO_C_REQUIRE("body_set_filter", filter);
  Filter taken;
  take_plain("body_set_filter", filter, taken);
  return change_body(world, "body_set_filter", body, [&](auto& w, BodyId id) { w.set_filter(id, taken); });
}
iso_status iso_body_set_user_data(iso_world* world, iso_body body, uint64_t user_data) {
  return change_body(world, "body_set_user_data", body, [&](auto& w, BodyId id) { w.set_user_data(id, user_data); });
}
iso_status iso_bodies_destroy(iso_world* world, const iso_body* bodies, size_t count, size_t* destroyed) {
  constexpr const char* kCall = "bodies_destroy";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (count != 0) ISO_C_REQUIRE(kCall, bodies);
    std::vector<BodyId> ids(count);
    for (std::size_t i = 0; i < count; ++i) ids[i] = id_of<BodyId>(bodies[i]);
    const std::size_t gone = of.world.destroy(ids);
    refusal_here().happened = false;  // ids of nothing are told by the count
    if (destroyed != nullptr) *destroyed = gone;
    return kOk;
  });
}

uint8_t iso_body_exists(const iso_world* world, iso_body body) { return exists<BodyId>(world, "body_exists", body); }
uint8_t iso_shape_exists(const iso_world* world, iso_shape shape) {
  return exists<ShapeId>(world, "shape_exists", shape);
}
uint8_t iso_joint_exists(const iso_world* world, iso_joint joint) {
  return exists<JointId>(world, "joint_exists", joint);
}

#define ISO_BODY_VECTORS(P, S, name, first, second, may_be_null, method)                         \
  iso_status iso_##P##_body_##name(iso_world* world, iso_body body, const iso_##P##_vec3* first, \
                                   const iso_##P##_vec3* second) {                               \
    return set_vectors<S>(world, "body_" #name, body, first, second, may_be_null,                \
                          [](auto& w, BodyId id, auto a, auto b) { w.method(id, a, b); });       \
  }
#define ISO_BODIES(P, S)                                                                                            \
  iso_status iso_##P##_body_create(iso_world* world, const iso_##P##_body_definition* definition, iso_body* out) {  \
    return body_create<S>(world, definition, out);                                                                  \
  }                                                                                                                 \
  iso_status iso_##P##_body_get_state(const iso_world* world, iso_body body, iso_##P##_body_state* out) {           \
    return get_state<S>(world, body, out);                                                                          \
  }                                                                                                                 \
  iso_status iso_##P##_bodies_get_states(const iso_world* world, const iso_body* bodies, size_t count,              \
                                         iso_##P##_body_state* out) {                                               \
    return get_states<S>(world, bodies, count, out);                                                                \
  }                                                                                                                 \
  iso_status iso_##P##_body_get_properties(const iso_world* world, iso_body body, iso_##P##_body_properties* out) { \
    return get_properties<S>(world, body, out);                                                                     \
  }                                                                                                                 \
  iso_status iso_##P##_body_get_children(const iso_world* world, iso_body body, iso_##P##_child* out, size_t room,  \
                                         size_t* count) {                                                           \
    return get_children<S>(world, body, out, room, count);                                                          \
  }                                                                                                                 \
  iso_status iso_##P##_body_get_velocity_at(const iso_world* world, iso_body body, const iso_##P##_vec3* point,     \
                                            iso_##P##_vec3* out) {                                                  \
    return get_velocity_at<S>(world, body, point, out);                                                             \
  }                                                                                                                 \
  iso_status iso_##P##_body_set_pose(iso_world* world, iso_body body, const iso_##P##_pose* pose) {                 \
    return set_plain<S, Pose<S>>(world, "body_set_pose", body, pose,                                                \
                                 [](auto& w, BodyId id, const auto& to) { w.set_pose(id, to); });                   \
  }                                                                                                                 \
  iso_status iso_##P##_body_move_to(iso_world* world, iso_body body, const iso_##P##_pose* pose) {                  \
    return set_plain<S, Pose<S>>(world, "body_move_to", body, pose,                                                 \
                                 [](auto& w, BodyId id, const auto& to) { w.move_to(id, to); });                    \
  }                                                                                                                 \
  iso_status iso_##P##_body_set_material(iso_world* world, iso_body body, const iso_##P##_material* material) {     \
    return set_plain<S, Material<S>>(world, "body_set_material", body, material,                                    \
                                     [](auto& w, BodyId id, const auto& to) { w.set_material(id, to); });           \
  }                                                                                                                 \
  iso_status iso_##P##_body_set_type(iso_world* world, iso_body body, iso_body_type type,                           \
                                     const iso_##P##_body_mass* mass) {                                             \
    return set_type<S>(world, body, type, mass);                                                                    \
  }                                                                                                                 \
  iso_status iso_##P##_body_set_mass(iso_world* world, iso_body body, const iso_##P##_body_mass* mass) {            \
    return set_mass<S>(world, body, mass);                                                                          \
  }                                                                                                                 \
  iso_status iso_##P##_body_set_shape(iso_world* world, iso_body body, iso_shape shape,                             \
                                      const iso_##P##_body_mass* mass) {                                            \
    return set_shape<S>(world, body, shape, mass);                                                                  \
  }                                                                                                                 \
  ISO_BODY_VECTORS(P, S, set_velocity, linear, angular, false, set_velocity)                                        \
  ISO_BODY_VECTORS(P, S, apply_force, force, torque, true, apply_force)                                             \
  ISO_BODY_VECTORS(P, S, apply_force_at, force, point, false, apply_force_at)                                       \
  ISO_BODY_VECTORS(P, S, apply_impulse, impulse, angular_impulse, true, apply_impulse)                              \
  ISO_BODY_VECTORS(P, S, apply_impulse_at, impulse, point, false, apply_impulse_at)
ISO_C_FAMILIES(ISO_BODIES)

#define ISO_NUMBERED(P, S, N)                                                                                   \
  iso_status iso_##P##_body_get_inertia(const iso_world* world, iso_body body, const iso_##P##_unit_vec3* axis, \
                                        N* out) {                                                               \
    return get_inertia<S>(world, body, axis, out);                                                              \
  }                                                                                                             \
  iso_status iso_##P##_body_set_motion(iso_world* world, iso_body body, N gravity_scale, N linear_damping,      \
                                       N angular_damping, uint32_t locks) {                                     \
    return set_motion<S, N>(world, body, {gravity_scale, linear_damping, angular_damping}, locks);              \
  }
ISO_NUMBERED(f32, float, float)
ISO_NUMBERED(f64, double, double)
ISO_NUMBERED(q16, Q16_16, std::int32_t)
ISO_NUMBERED(q32, Q32_32, std::int64_t)
#undef ISO_NUMBERED
