// Facts about a scene's body for the laboratory: mass, volume and where its middle is, in double.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/math/vec3.hpp"
#include "scenes/distance.hpp"
#include "scenes/measure.hpp"
#include "scenes/scene.hpp"

namespace isostep::tool::lab {

struct BodyFacts {
  double volume = 0;                   // [m^3] of the parts, as if none lay in another; half-spaces have none
  double mass = 0;                     // [kg]
  double radius = 0;                   // [m] of the sphere of that volume
  Vec3<double> centre = {};            // [m] of the volume, world
  Vec3<double> velocity = {};          // [m/s] of the centre
  Vec3<double> angular_velocity = {};  // [rad/s]
  std::vector<scenes::Solid> solids;   // the parts, in the world
};
BodyFacts facts_of(const scenes::SceneBody& body);

double value_of(const scenes::Number& number);
Vec3<double> value_of(const scenes::Vector& vector);
using scenes::length_of;

}  // namespace isostep::tool::lab
