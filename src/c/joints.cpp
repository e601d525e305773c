// Joints, by name and by their properties; couplings; ragdolls.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

/// The definition that a preset's numbers make: make(preset).
template <class S, class Preset, class Make>
iso_status create(iso_world* world, const char* call, const void* from, iso_joint* out, const Make& make) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(call, out);
    Preset preset;
    const iso_status taken = take_sized(call, from, preset);
    if (taken != kOk) return taken;
    if constexpr (requires { preset.drive_count; }) {
      if (preset.drive_count > kJointAxes) return refuse(kMisused, call, "drive_count", "6 at most");
    }
    return put_id(of.world.create(make(preset)), out);
  });
}

template <class S>
iso_status joint_between(const iso_world* world, const char* call, iso_joint_type type, iso_body a, const void* frame_a,
                         iso_body b, const void* frame_b, void* out) {
  return in_world<S>(world, call, Access::reads, [&](auto& of) {
    if (type >= Enumerators<JointType>::kCount) return refuse(ISO_BAD_ENUM, call, "type");
    Pose<S> at_a = Pose<S>::identity(), at_b = Pose<S>::identity();
    iso_status status = take_plain(call, frame_a, at_a);
    if (status == kOk) status = take_plain(call, frame_b, at_b);
    if (status != kOk) return status;
    const BodyId body_a = id_of<BodyId>(a), body_b = id_of<BodyId>(b);
    for (const BodyId body : {body_a, body_b}) {
      if (body && !of.world.contains(body)) return refuse({Fault::stale_id, call, "body", "a body of this world"});
    }
    return put_sized(call, out, of.world.joint_between(static_cast<JointType>(type), body_a, at_a, body_b, at_b));
  });
}

template <class S> iso_status joint_create(iso_world* world, const void* from, iso_joint* out) {
  return create<S, JointProperties<S>>(world, "joint_create", from, out, [](const auto& joint) { return joint; });
}
template <class S> iso_status joint_set(iso_world* world, iso_joint joint, const void* from) {
  constexpr const char* kCall = "joint_set";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    JointProperties<S> properties;
    const iso_status taken = take_sized(kCall, from, properties);
    if (taken == kOk) of.world.set_joint(id_of<JointId>(joint), properties);
    return taken;
  });
}

/// Puts a question to a joint that exists: ask(world, id).
template <class World, class Ask>
iso_status ask_joint(const World& world, const char* call, iso_joint joint, const void* out, const Ask& ask) {
  ISO_C_REQUIRE(call, out);
  const JointId id = id_of<JointId>(joint);
  if (!world.contains(id)) return refuse({Fault::stale_id, call, "joint", "a joint of this world"});
  return ask(world, id);
}
/// A setter of numbers: `set(world, joint)`.
template <class S, class Set>
iso_status change_joint(iso_world* world, const char* call, iso_joint joint, const Set& set) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    set(of.world, id_of<JointId>(joint));
    return kOk;
  });
}
template <class S, class Ask>
iso_status of_joint(const iso_world* world, const char* call, iso_joint joint, const void* out, const Ask& ask) {
  return in_world<S>(world, call, Access::reads, [&](auto& of) { return ask_joint(of.world, call, joint, out, ask); });
}
iso_status require_axis(const char* call, iso_joint_axis axis) {
  return axis >= Enumerators<JointAxis>::kCount ? refuse(ISO_BAD_ENUM, call, "axis") : kOk;
}
template <class S> iso_status joint_get(const iso_world* world, iso_joint joint, void* out) {
  return of_joint<S>(world, "joint_get", joint, out,
                     [&](auto& w, JointId id) { return put_sized("joint_get", out, *w.joint(id)); });
}
template <class S> iso_status get_error(const iso_world* world, iso_joint joint, void* out) {
  return of_joint<S>(world, "joint_get_error", joint, out, [&](auto& w, JointId id) {
    put_plain(out, w.joint_error(id));
    return kOk;
  });
}
template <class S> iso_status get_position(const iso_world* world, iso_joint joint, void* out) {
  return of_joint<S>(world, "joint_get_position", joint, out, [&](auto& w, JointId id) {
    put_plain(out, w.joint_position(id));
    return kOk;
  });
}
template <class S>
iso_status get_axis_position(const iso_world* world, iso_joint joint, iso_joint_axis axis, void* out) {
  constexpr const char* kCall = "joint_get_axis_position";
  return of_joint<S>(world, kCall, joint, out, [&](auto& w, JointId id) {
    const iso_status status = require_axis(kCall, axis);
    if (status == kOk) put_plain(out, w.joint_position(id, static_cast<JointAxis>(axis)));
    return status;
  });
}

template <class S>
iso_status add_ragdoll(iso_world* world, const void* bones, std::size_t count, const void* settings, iso_body* bodies,
                       iso_joint* joints) {
  constexpr const char* kCall = "add_ragdoll";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    if (count == 0) return refuse(kMisused, kCall, "count", "1 or more");
    ISO_C_REQUIRE(kCall, bones);
    ISO_C_REQUIRE(kCall, bodies);
    ISO_C_REQUIRE(kCall, joints);
    RagdollSettings<S> alike;
    if (settings != nullptr) {
      const iso_status taken = take_sized(kCall, settings, alike);
      if (taken != kOk) return taken;
    }
    std::vector<RagdollBone<S>> all(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto* const at = static_cast<const std::uint8_t*>(bones) + i * extent_of<RagdollBone<S>>().size;
      const iso_status taken = take_plain(kCall, at, all[i]);
      if (taken != kOk) return taken;
    }
    const Ragdoll<S> made = isostep::add_ragdoll<S>(of.world, all, alike);
    for (std::size_t i = 0; i < made.bodies.size(); ++i) {
      bodies[i] = id_bits(made.bodies[i]);
      joints[i] = id_bits(made.joints[i]);
    }
    return kOk;
  });
}

template <class S> iso_status put_coupling(const char* call, void* out, const Coupling<S>& coupling) {
  return put_sized(call, out, coupling);
}
template <class S> iso_status not_zero(const char* call, const char* name, S value) {
  return value == S(0) ? refuse(kMisused, call, name, "not 0") : kOk;
}

}  // namespace

iso_status iso_joint_destroy(iso_world* world, iso_joint joint) {
  return in_any_world(world, "joint_destroy", Access::changes, [&](auto& of) {
    of.world.destroy(id_of<JointId>(joint));
    return kOk;
  });
}

iso_status iso_joint_get_axis_drive(const iso_world* world, iso_joint joint, iso_joint_axis axis, iso_record* out) {
  constexpr const char* kCall = "joint_get_axis_drive";
  return in_any_world(world, kCall, Access::reads, [&](auto& of) {
    return ask_joint(of.world, kCall, joint, out, [&](auto& w, JointId id) {
      const iso_status status = require_axis(kCall, axis);
      if (status == kOk) *out = id_bits(w.axis_drive(id, static_cast<JointAxis>(axis)));
      return status;
    });
  });
}

#define ISO_PRESET(P, S, name, builder)                                                                 \
  iso_status iso_##P##_create_##name(iso_world* world, const iso_##P##_##name* joint, iso_joint* out) { \
    return create<S, twin::name<S>>(world, "create_" #name, joint, out,                                 \
                                    [](const auto& preset) { return isostep::builder<S>(preset); });    \
  }
#define ISO_JOINTS(P, S)                                                                                              \
  ISO_PRESET(P, S, ball, ball)                                                                                        \
  ISO_PRESET(P, S, constant_velocity, constant_velocity)                                                              \
  ISO_PRESET(P, S, fixed, fixed)                                                                                      \
  ISO_PRESET(P, S, universal, universal)                                                                              \
  ISO_PRESET(P, S, angular, angular)                                                                                  \
  ISO_PRESET(P, S, hinge, hinge)                                                                                      \
  ISO_PRESET(P, S, slider, slider)                                                                                    \
  ISO_PRESET(P, S, cylindrical, cylindrical)                                                                          \
  ISO_PRESET(P, S, planar, planar)                                                                                    \
  ISO_PRESET(P, S, rod, rod)                                                                                          \
  ISO_PRESET(P, S, rope, rope)                                                                                        \
  ISO_PRESET(P, S, wheel_joint, wheel)                                                                                \
  ISO_PRESET(P, S, motor_joint, motor)                                                                                \
  ISO_PRESET(P, S, six_axis, six_axis)                                                                                \
  iso_status iso_##P##_joint_at(const iso_world* world, iso_joint_type type, iso_body a, iso_body b,                  \
                                const iso_##P##_pose* frame, iso_##P##_joint_properties* out) {                       \
    return joint_between<S>(world, "joint_at", type, a, frame, b, frame, out);                                        \
  }                                                                                                                   \
  iso_status iso_##P##_joint_between(const iso_world* world, iso_joint_type type, iso_body a,                         \
                                     const iso_##P##_pose* frame_a, iso_body b, const iso_##P##_pose* frame_b,        \
                                     iso_##P##_joint_properties* out) {                                               \
    return joint_between<S>(world, "joint_between", type, a, frame_a, b, frame_b, out);                               \
  }                                                                                                                   \
  iso_status iso_##P##_joint_create(iso_world* world, const iso_##P##_joint_properties* joint, iso_joint* out) {      \
    return joint_create<S>(world, joint, out);                                                                        \
  }                                                                                                                   \
  iso_status iso_##P##_joint_set(iso_world* world, iso_joint joint, const iso_##P##_joint_properties* properties) {   \
    return joint_set<S>(world, joint, properties);                                                                    \
  }                                                                                                                   \
  iso_status iso_##P##_joint_get(const iso_world* world, iso_joint joint, iso_##P##_joint_properties* out) {          \
    return joint_get<S>(world, joint, out);                                                                           \
  }                                                                                                                   \
  iso_status iso_##P##_add_ragdoll(iso_world* world, const iso_##P##_ragdoll_bone* bones, size_t count,               \
                                   const iso_##P##_ragdoll_settings* settings, iso_body* bodies, iso_joint* joints) { \
    return add_ragdoll<S>(world, bones, count, settings, bodies, joints);                                             \
  }                                                                                                                   \
  iso_status iso_##P##_coupling_gears(iso_joint a, int32_t teeth_a, iso_joint b, int32_t teeth_b,                     \
                                      iso_##P##_coupling* out) {                                                      \
    constexpr const char* kCall = "coupling_gears";                                                                   \
    const bool has_teeth = 1 <= teeth_a && teeth_a <= kMostTeeth<S> && 1 <= teeth_b && teeth_b <= kMostTeeth<S>;      \
    if (!has_teeth) return refuse(kMisused, kCall, "teeth", kMostTeeth<S> == 128 ? "1 to 128" : "1 to 1024");         \
    return put_coupling<S>(kCall, out, gears<S>(id_of<JointId>(a), teeth_a, id_of<JointId>(b), teeth_b));             \
  }                                                                                                                   \
  iso_status iso_##P##_coupling_differential(iso_joint shaft, iso_joint left, iso_joint right,                        \
                                             iso_##P##_coupling* out) {                                               \
    return put_coupling<S>("coupling_differential", out,                                                              \
                           differential<S>(id_of<JointId>(shaft), id_of<JointId>(left), id_of<JointId>(right)));      \
  }                                                                                                                   \
  iso_status iso_##P##_coupling_mimic(iso_joint a, iso_joint b, iso_##P##_coupling* out) {                            \
    return put_coupling<S>("coupling_mimic", out, mimic<S>(id_of<JointId>(a), id_of<JointId>(b)));                    \
  }
ISO_C_FAMILIES(ISO_JOINTS)

#define ISO_NUMBERED(P, S, N)                                                                                          \
  iso_status iso_##P##_joint_set_limits(iso_world* world, iso_joint joint, N lower, N upper) {                         \
    return change_joint<S>(world, "joint_set_limits", joint,                                                           \
                           [&](auto& w, JointId id) { w.set_limits(id, same_bits<S>(lower), same_bits<S>(upper)); });  \
  }                                                                                                                    \
  iso_status iso_##P##_joint_set_motor(iso_world* world, iso_joint joint, N speed, N max_force) {                      \
    return change_joint<S>(world, "joint_set_motor", joint, [&](auto& w, JointId id) {                                 \
      w.set_motor(id, same_bits<S>(speed), same_bits<S>(max_force));                                                   \
    });                                                                                                                \
  }                                                                                                                    \
  iso_status iso_##P##_joint_set_spring(iso_world* world, iso_joint joint, N frequency, N damping) {                   \
    return change_joint<S>(world, "joint_set_spring", joint, [&](auto& w, JointId id) {                                \
      w.set_spring(id, same_bits<S>(frequency), same_bits<S>(damping));                                                \
    });                                                                                                                \
  }                                                                                                                    \
  iso_status iso_##P##_joint_set_target(iso_world* world, iso_joint joint, N target) {                                 \
    return change_joint<S>(world, "joint_set_target", joint,                                                           \
                           [&](auto& w, JointId id) { w.set_target(id, same_bits<S>(target)); });                      \
  }                                                                                                                    \
  iso_status iso_##P##_joint_get_error(const iso_world* world, iso_joint joint, N* out) {                              \
    return get_error<S>(world, joint, out);                                                                            \
  }                                                                                                                    \
  iso_status iso_##P##_joint_get_position(const iso_world* world, iso_joint joint, N* out) {                           \
    return get_position<S>(world, joint, out);                                                                         \
  }                                                                                                                    \
  iso_status iso_##P##_joint_get_axis_position(const iso_world* world, iso_joint joint, iso_joint_axis axis, N* out) { \
    return get_axis_position<S>(world, joint, axis, out);                                                              \
  }                                                                                                                    \
  iso_status iso_##P##_coupling_rack_and_pinion(iso_joint hinge, N radius, iso_joint slider,                           \
                                                iso_##P##_coupling* out) {                                             \
    constexpr const char* kCall = "coupling_rack_and_pinion";                                                          \
    const S r = same_bits<S>(radius);                                                                                  \
    const iso_status status = not_zero(kCall, "radius", r);                                                            \
    if (status != kOk) return status;                                                                                  \
    return put_coupling<S>(kCall, out, rack_and_pinion<S>(id_of<JointId>(hinge), r, id_of<JointId>(slider)));          \
  }                                                                                                                    \
  iso_status iso_##P##_coupling_screw(iso_joint hinge, N pitch, iso_joint slider, iso_##P##_coupling* out) {           \
    constexpr const char* kCall = "coupling_screw";                                                                    \
    const S p = same_bits<S>(pitch);                                                                                   \
    const iso_status status = not_zero(kCall, "pitch", p);                                                             \
    if (status != kOk) return status;                                                                                  \
    return put_coupling<S>(kCall, out, screw<S>(id_of<JointId>(hinge), p, id_of<JointId>(slider)));                    \
  }                                                                                                                    \
  iso_status iso_##P##_coupling_pulley(iso_joint a, iso_joint b, N ratio, N rope, iso_##P##_coupling* out) {           \
    return put_coupling<S>("coupling_pulley", out,                                                                     \
                           pulley<S>(id_of<JointId>(a), id_of<JointId>(b), same_bits<S>(ratio), same_bits<S>(rope)));  \
  }
ISO_NUMBERED(f32, float, float)
ISO_NUMBERED(f64, double, double)
ISO_NUMBERED(q16, Q16_16, std::int32_t)
ISO_NUMBERED(q32, Q32_32, std::int64_t)
#undef ISO_NUMBERED
