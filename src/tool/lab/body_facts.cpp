// Volumes and places of a scene's bodies.
// SPDX-License-Identifier: MIT
#include "body_facts.hpp"

#include <cmath>
#include <numbers>

#include "scenes/shape_keys.hpp"

namespace isostep::tool::lab {
namespace {

Mat3<double> axes_of(const scenes::Rotation& q) {
  return to_matrix(normalise(Quat<double>{value_of(q[0]), value_of(q[1]), value_of(q[2]), value_of(q[3])}));
}

/// See scenes::shape_of().
struct ReadSizes {
  double size(const char*, const scenes::Number& number) const { return value_of(number); }
  Vec3<double> sizes(const char*, const scenes::Vector& v) const { return value_of(v); }
  Vec3<double> direction(const char*, const scenes::Vector& v) const { return value_of(v); }
  std::uint32_t hull(const scenes::ScenePart&) const { return 1; }
  std::uint32_t mesh(const scenes::ScenePart&) const { return 1; }
  std::uint32_t height_field(const scenes::ScenePart&) const { return 1; }
};
Primitive<double> primitive_in(const scenes::ScenePart& part) {
  return visit_shape_type(part.type,
                          [&](auto tag) { return scenes::shape_of<double>(tag, part, ReadSizes{}).primitive(); });
}

scenes::Solid solid_of(const scenes::ScenePart& part, const Primitive<double>& shape, const Mat3<double>& axes,
                       Vec3<double> origin) {
  scenes::Solid solid = {};
  solid.type = shape.type;
  solid.axes = axes * axes_of(part.orientation);
  solid.centre = origin + axes * value_of(part.position);
  solid.half = shape.half;
  solid.radius = shape.radius;
  solid.normal = solid.axes * shape.normal;
  solid.offset = shape.offset + dot(solid.normal, solid.centre);
  if (part.type == ShapeType::mesh) solid.surface = scenes::solid_surface(*scenes::mesh_of_part(part, "mesh"));
  if (part.type == ShapeType::height_field)
    solid.surface = scenes::solid_surface(*scenes::height_field_of_part(part, "height field"));
  if (part.type == ShapeType::hull) solid.hull = scenes::solid_hull(*scenes::hull_of_part(part, "hull"));
  return solid;
}
double volume_of(const scenes::Solid& solid, const Primitive<double>& shape) {
  if (solid.hull != nullptr) return scenes::stretched(*solid.hull, solid.radius).volume;
  return visit_shape(shape, [](const auto& visited) { return visited.mass(1.0); });
}
Vec3<double> middle_of(const scenes::Solid& solid) {
  return solid.hull == nullptr ? solid.centre : solid.centre + solid.axes * solid.hull->centre;
}

}  // namespace

double value_of(const scenes::Number& number) {
  double value = 0;
  TextError error = TextError::none;
  if (!number.read(value, error)) throw scenes::SceneError("", number.text() + " is no number");
  return value;
}
Vec3<double> value_of(const scenes::Vector& vector) {
  return {value_of(vector[0]), value_of(vector[1]), value_of(vector[2])};
}
BodyFacts facts_of(const scenes::SceneBody& body) {
  BodyFacts facts;
  const Mat3<double> axes = axes_of(body.orientation);
  const Vec3<double> origin = value_of(body.position);
  Vec3<double> moment = {0, 0, 0};
  for (const scenes::ScenePart& part : body.parts) {
    const Primitive<double> shape = primitive_in(part);
    facts.solids.push_back(solid_of(part, shape, axes, origin));
    const double volume = volume_of(facts.solids.back(), shape);
    facts.volume += volume;
    moment += middle_of(facts.solids.back()) * volume;
  }
  const double mass = value_of(body.mass);
  facts.mass = mass > 0 ? mass : value_of(body.density) * facts.volume;
  facts.radius = std::cbrt(facts.volume * 3 / (4 * std::numbers::pi));
  facts.centre = facts.volume > 0 ? moment * (1 / facts.volume) : origin;
  facts.angular_velocity = value_of(body.angular_velocity);
  facts.velocity = value_of(body.velocity);
  return facts;
}

}  // namespace isostep::tool::lab
