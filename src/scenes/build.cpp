// The builder, for every scalar of the library.
// SPDX-License-Identifier: MIT
#include "build.hpp"

#include <map>

#include "hull_points.hpp"
#include "isostep/geometry/validate.hpp"
#include "scene_records.hpp"
#include "shape_keys.hpp"
#include "surface_points.hpp"

namespace isostep::scenes {
namespace {

template <class T> T read(const Number& number, const std::string& place) {
  T value{};
  TextError error = TextError::none;
  if (number.read(value, error)) return value;
  const std::string scalar = ScalarTraits<T>::kName;
  throw SceneError(place, error == TextError::out_of_range ? number.text() + " is out of range for " + scalar
                                                           : "expected a number, found " + number.text());
}
template <class T> Vec3<T> read(const Vector& v, const std::string& place) {
  const T x = read<T>(v[0], place + "/0");
  const T y = read<T>(v[1], place + "/1");
  return {x, y, read<T>(v[2], place + "/2")};
}
template <class U> Quat<U> read(const Rotation& q, const std::string& place) {
  const U x = read<U>(q[0], place + "/0");
  const U y = read<U>(q[1], place + "/1");
  const U z = read<U>(q[2], place + "/2");
  return {x, y, z, read<U>(q[3], place + "/3")};
}

/// See shape_of().
template <class S> struct ReadSizes {
  std::string place;
  std::vector<BlobRef>& blobs;
  S size(const char* key, const Number& number) const { return read<S>(number, place + "/" + key); }
  Vec3<S> sizes(const char* key, const Vector& v) const { return read<S>(v, place + "/" + key); }
  Vec3<Unit<S>> direction(const char* key, const Vector& v) const { return read<Unit<S>>(v, place + "/" + key); }
  std::uint32_t hull(const ScenePart& part) const {
    blobs.push_back(hull_of_part(part, place));
    return static_cast<std::uint32_t>(blobs.size());
  }
  std::uint32_t mesh(const ScenePart& part) const {
    blobs.push_back(mesh_of_part(part, place));
    return static_cast<std::uint32_t>(blobs.size());
  }
  std::uint32_t height_field(const ScenePart& part) const {
    blobs.push_back(height_field_of_part(part, place));
    return static_cast<std::uint32_t>(blobs.size());
  }
};
template <class S>
Primitive<S> primitive(const ScenePart& part, std::vector<BlobRef>& blobs, const std::string& place) {
  return visit_shape_type(part.type, [&](auto tag) {
    return primitive_of(shape_of<S>(tag, part, ReadSizes<S>{place, blobs}));
  });
}

[[noreturn]] void fail_part(const ScenePart& part, const std::string& place, ShapeFault fault) {
  if (fault == ShapeFault::radius_not_in_range) throw SceneError(place + "/radius", describe(fault));
  if (part.file.empty()) throw SceneError(place, describe(fault));
  throw SceneError(place + "/file", part.file + ": " + describe(fault));
}

template <class S> PartTraits<S> traits_of(const ScenePartTraits& own, const std::string& at) {
  PartTraits<S> traits;
  traits.flags = own.flags;
  if (traits.has(part_flag::kOwnFilter)) traits.filter = own.filter;
  if (!traits.has(part_flag::kOwnMaterial)) return traits;
  traits.material = Material<S>{};
  traits.material.friction = read<S>(own.friction, at + "/friction");
  traits.material.static_friction = read<S>(own.static_friction, at + "/static_friction");
  traits.material.restitution = read<S>(own.restitution, at + "/restitution");
  traits.material.rolling_resistance = read<S>(own.rolling_resistance, at + "/rolling_resistance");
  traits.material.spin_resistance = read<S>(own.spin_resistance, at + "/spin_resistance");
  traits.material.kind = own.kind;
  return traits;
}

template <class S> ShapeId add_shape(World<S>& world, const SceneBody& body, const std::string& place) {
  std::vector<Child<S>> children;
  std::vector<BlobRef> blobs;
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    const std::string at = place + "/shapes/" + std::to_string(i);
    const Primitive<S> shape = primitive<S>(body.parts[i], blobs, at);
    const Vec3<S> position = read<S>(body.parts[i].position, at + "/position");
    const Quat<Unit<S>> orientation = read<Unit<S>>(body.parts[i].orientation, at + "/orientation");
    children.push_back({shape, {position, orientation}, traits_of<S>(body.parts[i].own, at)});
    if (!is_bounded(shape.type) && body.type == BodyType::dynamic) {
      throw SceneError(at,
                       std::string("a ") + kShapeNames[static_cast<std::size_t>(shape.type)] + " is for static bodies");
    }
    const ShapeFault fault = validate(std::span<const Child<S>>(&children.back(), 1), blobs);
    if (fault != ShapeFault::none) fail_part(body.parts[i], at, fault);
  }
  const ShapeId shape = world.add_shape(std::span<const Child<S>>(children), blobs);
  if (!shape) {
    const ShapeFault fault = validate(std::span<const Child<S>>(children), blobs);
    throw SceneError(place + "/shapes", fault == ShapeFault::none ? describe(world.fault()) : describe(fault));
  }
  return shape;
}

template <class S>
BodyDefinition<S> definition_of(const SceneBody& body, ShapeId shape, std::uint64_t user_data,
                                const std::string& place) {
  BodyDefinition<S> d;
  d.type = body.type;
  d.shape = shape;
  d.position = read<S>(body.position, place + "/position");
  d.orientation = read<Unit<S>>(body.orientation, place + "/orientation");
  d.velocity = read<S>(body.velocity, place + "/velocity");
  d.angular_velocity = read<S>(body.angular_velocity, place + "/angular_velocity");
  d.density = read<S>(body.density, place + "/density");
  d.mass = read<S>(body.mass, place + "/mass");
  d.inertia = read<S>(body.inertia, place + "/inertia");
  d.material.friction = read<S>(body.friction, place + "/friction");
  d.material.restitution = read<S>(body.restitution, place + "/restitution");
  d.material.rolling_resistance = read<S>(body.rolling_resistance, place + "/rolling_resistance");
  d.material.spin_resistance = read<S>(body.spin_resistance, place + "/spin_resistance");
  d.material.surface_velocity = read<S>(body.surface_velocity, place + "/surface_velocity");
  d.material.static_friction = read<S>(body.static_friction, place + "/static_friction");
  d.material.anisotropy = read<S>(body.anisotropy, place + "/anisotropy");
  d.material.kind = body.kind;
  d.gravity_scale = read<S>(body.gravity_scale, place + "/gravity_scale");
  d.linear_damping = read<S>(body.linear_damping, place + "/linear_damping");
  d.angular_damping = read<S>(body.angular_damping, place + "/angular_damping");
  d.locks = body.locks;
  d.filter.group = body.group;
  d.user_data = user_data;
  d.sensor = body.sensor;
  d.bullet = body.bullet;
  d.report_contacts = body.report_contacts;
  d.allow_sleep = body.allow_sleep;
  d.collide = body.collide;
  return d;
}

template <class S> BodyId create(World<S>& world, const BodyDefinition<S>& definition, const std::string& place) {
  const BodyId id = world.create(definition);
  if (!id) throw SceneError(place, std::string("the body is refused: ") + describe(world.fault()));
  return id;
}

std::string text_of(const Number& number) { return ' ' + number.text(); }
template <std::size_t N> std::string text_of(const std::array<Number, N>& numbers) {
  std::string text;
  for (const Number& number : numbers) text += text_of(number);
  return text;
}
std::string text_of(const std::vector<Vector>& vectors) {
  std::string text;
  for (const Vector& v : vectors) text += text_of(v);
  return text;
}
std::string text_of(const std::vector<Number>& numbers) {
  std::string text;
  for (const Number& number : numbers) text += text_of(number);
  return text;
}
std::string text_of(const std::string& file) { return ' ' + std::to_string(file.size()) + ':' + file; }
std::string text_of(const std::vector<SceneSurface>& surfaces) {
  std::string text;
  for (const SceneSurface& s : surfaces) text += text_of(s.friction) + text_of(s.restitution);
  return text;
}
std::string text_of(const ScenePartTraits& own) {
  std::string text = ' ' + std::to_string(own.flags);
  const auto add = [&](const char*, const auto& number) {
    if constexpr (std::is_same_v<decltype(number), const Number&>) text += text_of(number);
    else text += ' ' + std::to_string(number);
  };
  visit_part_material(own, add);
  visit_part_filter(own, add);
  return text;
}
/// Bodies of equal parts share one shape.
std::string key_of(const SceneBody& body) {
  std::string key;
  for (const ScenePart& part : body.parts) {
    key += std::to_string(static_cast<unsigned>(part.type));
    visit_sizes(part, [&](const char*, const auto& size, SizeRule) { key += text_of(size); });
    key += text_of(part.position) + text_of(part.orientation) + text_of(part.own);
  }
  return key;
}

template <class S>
JointId add_joint(World<S>& world, const SceneJoint& joint, const std::vector<BodyId>& bodies,
                  const std::string& place) {
  const auto body = [&](int index) { return index < 0 ? BodyId{} : bodies[static_cast<std::size_t>(index)]; };
  const Quat<Unit<S>> axes = read<Unit<S>>(joint.orientation, place + "/orientation");
  const Pose<S> frame = {read<S>(joint.anchor, place + "/anchor"), axes};
  JointProperties<S> properties = world.joint_at(joint.type, body(joint.a), body(joint.b), frame);
  if (joins_two_points(joint.type)) {
    const Pose<S> other = {read<S>(joint.anchor_b, place + "/anchor_b"), axes};
    properties.frame_b = world.joint_at(joint.type, body(joint.a), body(joint.b), other).frame_b;
  }
  properties.flags = joint.flags;
  properties.lower = read<S>(joint.lower, place + "/lower");
  properties.upper = read<S>(joint.upper, place + "/upper");
  properties.cone = read<S>(joint.cone, place + "/cone");
  properties.motor_speed = read<S>(joint.motor_speed, place + "/motor_speed");
  properties.max_force = read<S>(joint.max_force, place + "/max_force");
  properties.spring_target = read<S>(joint.spring_target, place + "/spring_target");
  properties.spring_frequency = read<S>(joint.spring_frequency, place + "/spring_frequency");
  properties.spring_damping = read<S>(joint.spring_damping, place + "/spring_damping");
  const JointId id = world.create(properties);
  if (!id) throw SceneError(place, std::string("the joint is refused: ") + describe(world.fault()));
  return id;
}

}  // namespace

template <class S> S value_of(const Number& number, const std::string& place) { return read<S>(number, place); }

template <class S> Settings<S> settings_of(const Scene& scene) {
  if (const char* why = left_out(scene)) throw SceneError("", why);
  Settings<S> settings;
  settings.hz = scene.hz;
  settings.substeps = scene.substeps;
  settings.solver = scene.solver;
  settings.projection = scene.projection;
  settings.gravity = read<S>(scene.gravity, "/gravity");
  settings.allow_sleep = scene.allow_sleep;
  settings.restitution_threshold = read<S>(scene.restitution_threshold, "/restitution_threshold");
  if (static_cast<long long>(scene.hz) * scene.substeps > kMaxRate) {
    throw SceneError("hz and substeps", "more than " + std::to_string(kMaxRate) + " sub-steps a second");
  }
  if (const World<S> probe(settings); probe.fault() != Fault::none) {
    const bool threshold = probe.settings().restitution_threshold != settings.restitution_threshold;
    throw SceneError(
        threshold ? "/restitution_threshold" : "/gravity",
        std::string(threshold ? "below 0, or " : "") + "beyond the greatest speed of " + ScalarTraits<S>::kName);
  }
  return settings;
}

template <class S>
BodyId add_body(World<S>& world, const SceneBody& body, std::uint64_t user_data, const std::string& place) {
  const ShapeId shape = add_shape<S>(world, body, place);
  return create(world, definition_of<S>(body, shape, user_data, place), place);
}

template <class S> Built<S> build(const Scene& scene, World<S>& world) {
  Built<S> built;
  if (const char* why = isostep::left_out(scene.broad_phase)) throw SceneError("", why);
  if (scene.broad_phase != Scene{}.broad_phase) world.use_broad_phase(scene.broad_phase);
  std::map<std::string, ShapeId> shapes;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const std::string place = "/bodies/" + std::to_string(i);
    ShapeId& shape = shapes[key_of(body)];
    if (!shape) shape = add_shape<S>(world, body, place);
    built.bodies.push_back(create(world, definition_of<S>(body, shape, i + 1, place), place));
  }
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    built.joints.push_back(add_joint<S>(world, scene.joints[i], built.bodies, "/joints/" + std::to_string(i)));
  }
  add_records(world, scene, {built.bodies, built.joints});
  return built;
}

#define ISO_INSTANTIATE(S)                                                                     \
  template Settings<S> settings_of<S>(const Scene&);                                           \
  template Built<S> build<S>(const Scene&, World<S>&);                                         \
  template BodyId add_body<S>(World<S>&, const SceneBody&, std::uint64_t, const std::string&); \
  template S value_of<S>(const Number&, const std::string&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
