// Boxes and capsules as spheres.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "model_checks.hpp"
#include "models.hpp"

namespace isostep::tool::lab {
namespace {

scenes::SceneBody sphere_of(const scenes::SceneBody& body, const BodyFacts& facts) {
  scenes::SceneBody sphere = body;
  scenes::ScenePart part;
  part.type = ShapeType::sphere;
  part.radius = facts.radius;
  sphere.parts = {part};
  sphere.position = {facts.centre.x, facts.centre.y, facts.centre.z};
  sphere.orientation = scenes::no_rotation();
  sphere.inertia = scenes::zero_vector();
  return sphere;
}

}  // namespace

Offer<scenes::Scene> sphere_model(const scenes::Scene& scene) {
  if (!scene.joints.empty()) return {{}, "its joints hold shapes, not spheres"};
  if (scene.script != scenes::Script::none) return {{}, "its script makes bodies of its own"};
  scenes::Scene model = scene;
  std::vector<BodyFacts> facts;
  bool differs = false;
  for (scenes::SceneBody& body : model.bodies) {
    facts.push_back(facts_of(body));
    if (body.type != BodyType::dynamic || is_ball(body)) continue;
    differs = true;
    body = sphere_of(body, facts.back());
  }
  if (!differs) return {{}, "its bodies are spheres already"};
  const std::string overlap = overlap_of_spheres(scene, facts);
  if (!overlap.empty()) return {{}, overlap};
  return {model, ""};
}

}  // namespace isostep::tool::lab
