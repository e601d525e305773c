// Mass and inertia of a scene's bodies, by themselves: judges do not ask the engine that they judge.
// SPDX-License-Identifier: MIT
#include "scene_numbers.hpp"

#include <algorithm>
#include <numbers>

namespace isostep::scenes {
namespace {

static_assert(kShapeTypes == 4, "a judge knows each shape by itself: see volume_of(), gyration_of(), least_reach()");

double volume_of(const ScenePart& part) {
  const Vec3<double> half = value(part.half_extents);
  const double r = value(part.radius);
  const double ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  if (part.type == ShapeType::box) return 8 * half.x * half.y * half.z;
  return part.type == ShapeType::capsule ? ball + 2 * value(part.half_height) * std::numbers::pi * r * r : ball;
}
double volume_of(const SceneBody& body) {
  double volume = 0;
  for (const ScenePart& part : body.parts) volume += volume_of(part);
  return volume;
}

/// [m^2] about the part's own centre, a kilogram of it.
Vec3<double> gyration_of(const ScenePart& part) {
  if (part.type == ShapeType::sphere) {
    const double r = value(part.radius), square = 0.4 * r * r;
    return {square, square, square};
  }
  if (part.type == ShapeType::capsule) {  // a cylinder, and a ball whose halves stand away from each other
    const double r = value(part.radius), h = value(part.half_height);
    const double ball = 4 * r / (4 * r + 6 * h), cylinder = 1 - ball;
    const double along = r * r * (0.4 * ball + 0.5 * cylinder);
    const double across = ball * (0.4 * r * r + h * h + 0.75 * h * r) + cylinder * (r * r / 4 + h * h / 3);
    return {across, along, across};
  }
  const Vec3<double> half = value(part.half_extents);
  const Vec3<double> square = {half.x * half.x / 3, half.y * half.y / 3, half.z * half.z / 3};
  return {square.y + square.z, square.z + square.x, square.x + square.y};
}

}  // namespace

double mass_of(const SceneBody& body) {
  const double mass = value(body.mass);
  return mass > 0 ? mass : value(body.density) * volume_of(body);
}

/// Parallel axes: m (|r|^2 - r r^T) of each part.
Mat3<double> inertia_of(const SceneBody& body) {
  const double density = mass_of(body) / volume_of(body);
  Vec3<double> centre = {0, 0, 0};
  for (const ScenePart& part : body.parts) centre += value(part.position) * (volume_of(part) / volume_of(body));
  Mat3<double> inertia = Mat3<double>::diagonal({0, 0, 0});
  for (const ScenePart& part : body.parts) {
    const double mass = density * volume_of(part);
    const Vec3<double> arm = value(part.position) - centre, own = gyration_of(part);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double along = i == k ? own[i] + dot(arm, arm) : 0.0;
        inertia.rows[i][k] = inertia.rows[i][k] + mass * (along - arm[i] * arm[k]);
      }
    }
  }
  return inertia;
}

double least_reach(const SceneBody& body) {
  const ScenePart& part = body.parts.front();
  if (part.type != ShapeType::box) return value(part.radius);
  const Vec3<double> half = value(part.half_extents);
  return std::min({half.x, half.y, half.z});
}

}  // namespace isostep::scenes
