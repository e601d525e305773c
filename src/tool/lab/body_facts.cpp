// Volumes and places of a scene's bodies.
// SPDX-License-Identifier: MIT
#include "body_facts.hpp"

#include <cmath>

namespace isostep::tool::lab {
namespace {

constexpr double kPi = 3.14159265358979323846;

double volume_of(const scenes::Solid& solid) {
  const double ball = 4 * kPi / 3 * std::pow(solid.radius, 3);
  switch (solid.type) {
    case ShapeType::sphere: return ball;
    case ShapeType::box: return 8 * solid.half.x * solid.half.y * solid.half.z;
    case ShapeType::capsule: return ball + kPi * solid.radius * solid.radius * 2 * solid.half.y;
    case ShapeType::half_space: return 0;
  }
  return 0;
}

Mat3<double> axes_of(const scenes::Rotation& q) {
  return to_matrix(normalise(Quat<double>{value_of(q[0]), value_of(q[1]), value_of(q[2]), value_of(q[3])}));
}

scenes::Solid solid_of(const scenes::ScenePart& part, const Mat3<double>& axes, Vec3<double> origin) {
  scenes::Solid solid = {};
  solid.type = part.type;
  solid.axes = axes * axes_of(part.orientation);
  solid.centre = origin + axes * value_of(part.position);
  if (part.type == ShapeType::box) solid.half = value_of(part.half_extents);
  if (part.type == ShapeType::capsule) solid.half = {0, value_of(part.half_height), 0};
  if (part.type == ShapeType::sphere || part.type == ShapeType::capsule) solid.radius = value_of(part.radius);
  if (part.type == ShapeType::half_space) {
    solid.normal = solid.axes * value_of(part.normal);
    solid.offset = value_of(part.offset) + dot(solid.normal, solid.centre);
  }
  return solid;
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
    facts.solids.push_back(solid_of(part, axes, origin));
    const double volume = volume_of(facts.solids.back());
    facts.volume += volume;
    moment += facts.solids.back().centre * volume;
  }
  const double mass = value_of(body.mass);
  facts.mass = mass > 0 ? mass : value_of(body.density) * facts.volume;
  facts.radius = std::cbrt(facts.volume * 3 / (4 * kPi));
  facts.centre = facts.volume > 0 ? moment * (1 / facts.volume) : origin;
  facts.spin = value_of(body.angular_velocity);
  facts.velocity = value_of(body.velocity);
  return facts;
}

}  // namespace isostep::tool::lab
