// Mass and inertia of a scene's bodies, by themselves: judges do not ask the engine that they judge.
// SPDX-License-Identifier: MIT
#include "scene_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/hull_points.hpp"

namespace isostep::scenes {
namespace {

static_assert(kShapeTypes == 9,
              "a judge knows each shape by itself: see volume_of(), centre_of(), gyration_of(), least_reach()");

std::shared_ptr<const SolidHull> hull_of(const ScenePart& part) { return solid_hull(*hull_of_part(part, "hull")); }

double volume_of(const ScenePart& part) {
  if (part.type == ShapeType::hull) return stretched(*hull_of(part), value(part.radius)).volume;
  const Vec3<double> half = value(part.half_extents);
  const double r = value(part.radius);
  const double ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  if (part.type == ShapeType::box) return 8 * half.x * half.y * half.z;
  const double cylinder = 2 * value(part.half_height) * std::numbers::pi * r * r;
  if (part.type == ShapeType::cylinder) return cylinder;
  if (part.type == ShapeType::cone) return cylinder / 3;
  return part.type == ShapeType::capsule ? ball + cylinder : ball;
}
double volume_of(const SceneBody& body) {
  double volume = 0;
  for (const ScenePart& part : body.parts) volume += volume_of(part);
  return volume;
}

/// [m] The centre of mass in the body's frame: parts stand as the body does.
Vec3<double> centre_of(const ScenePart& part) {
  const Vec3<double> position = value(part.position);
  if (part.type == ShapeType::cone) return position + Vec3<double>{0, value(part.half_height) / -2, 0};
  return part.type == ShapeType::hull ? position + hull_of(part)->centre : position;
}

/// [m^2] The inertia of a kilogram of the part about its own centre.
Mat3<double> gyration_of_hull(const Mat3<double>& moments) {
  const double trace = moments.rows[0].x + moments.rows[1].y + moments.rows[2].z;
  Mat3<double> gyration = Mat3<double>::diagonal({trace, trace, trace});
  for (int i = 0; i < 3; ++i) gyration.rows[i] = gyration.rows[i] - moments.rows[i];
  return gyration;
}
Vec3<double> principal_gyration_of(const ScenePart& part) {
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
  if (part.type == ShapeType::cylinder || part.type == ShapeType::cone) {
    const double r = value(part.radius), h = value(part.half_height);
    if (part.type == ShapeType::cone) return {0.15 * (r * r + h * h), 0.3 * r * r, 0.15 * (r * r + h * h)};
    return {r * r / 4 + h * h / 3, r * r / 2, r * r / 4 + h * h / 3};
  }
  const Vec3<double> half = value(part.half_extents);
  const Vec3<double> square = {half.x * half.x / 3, half.y * half.y / 3, half.z * half.z / 3};
  return {square.y + square.z, square.z + square.x, square.x + square.y};
}
Mat3<double> gyration_of(const ScenePart& part) {
  return part.type == ShapeType::hull ? gyration_of_hull(stretched(*hull_of(part), value(part.radius)).moments)
                                      : Mat3<double>::diagonal(principal_gyration_of(part));
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
  for (const ScenePart& part : body.parts) centre += centre_of(part) * (volume_of(part) / volume_of(body));
  Mat3<double> inertia = Mat3<double>::diagonal({0, 0, 0});
  for (const ScenePart& part : body.parts) {
    const double mass = density * volume_of(part);
    const Vec3<double> arm = centre_of(part) - centre;
    const Mat3<double> own = gyration_of(part);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double along = i == k ? dot(arm, arm) : 0.0;
        inertia.rows[i][k] = inertia.rows[i][k] + mass * (own.rows[i][k] + along - arm[i] * arm[k]);
      }
    }
  }
  return inertia;
}

double least_reach(const SceneBody& body) {
  const ScenePart& part = body.parts.front();
  if (part.type == ShapeType::hull) return hull_of(part)->inner_radius + value(part.radius);
  if (part.type == ShapeType::cylinder) return std::min(value(part.radius), value(part.half_height));
  if (part.type == ShapeType::cone) {
    const double r = value(part.radius), height = 2 * value(part.half_height);
    return r * height / (r + std::hypot(r, height));
  }
  if (part.type != ShapeType::box) return value(part.radius);
  const Vec3<double> half = value(part.half_extents);
  return std::min({half.x, half.y, half.z});
}

}  // namespace isostep::scenes
