// The spheres of a scene at its start, swept along x.
// SPDX-License-Identifier: MIT
#include "model_checks.hpp"

#include <algorithm>
#include <cstdio>

namespace isostep::tool::lab {
namespace {

constexpr double kTolerated = 0.1;  // [1] of the smaller radius

std::string sentence(double depth, std::size_t a, std::size_t b) {
  char text[128];
  std::snprintf(text, sizeof text, "as spheres of their volume bodies %zu and %zu would start %.0f mm in one another",
                std::min(a, b), std::max(a, b), 1000 * depth);
  return text;
}

}  // namespace

bool is_ball(const scenes::SceneBody& body) {
  return body.parts.size() == 1 && body.parts[0].type == ShapeType::sphere;
}

std::string overlap_of_spheres(const scenes::Scene& scene, const std::vector<BodyFacts>& facts) {
  std::vector<std::size_t> moving, others;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].collide) continue;
    (scene.bodies[i].type == BodyType::dynamic ? moving : others).push_back(i);
  }
  const auto low = [&](std::size_t i) { return facts[i].centre.x - facts[i].radius; };
  std::stable_sort(moving.begin(), moving.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const BodyFacts& a = facts[moving[i]];
    for (std::size_t j = i + 1; j < moving.size() && low(moving[j]) < a.centre.x + a.radius; ++j) {
      const BodyFacts& b = facts[moving[j]];
      const double depth = a.radius + b.radius - length_of(a.centre - b.centre);
      if (depth > kTolerated * std::min(a.radius, b.radius)) return sentence(depth, moving[i], moving[j]);
    }
    scenes::Solid sphere = {};
    sphere.type = ShapeType::sphere;
    sphere.centre = a.centre;
    sphere.axes = Mat3<double>::identity();
    sphere.radius = a.radius;
    for (const std::size_t other : others) {
      for (const scenes::Solid& solid : facts[other].solids) {
        const double depth = -signed_distance(sphere, solid);
        if (depth > kTolerated * a.radius) return sentence(depth, moving[i], other);
      }
    }
  }
  return "";
}

}  // namespace isostep::tool::lab
