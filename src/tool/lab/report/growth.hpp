// Error growth: how far a scalar's run gets from the same method in double.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.hpp"
#include "scenes/sight.hpp"

namespace isostep::tool::lab {

struct GrowthSample {
  std::string scene, scalar;
  double time;      // [s] simulated
  double distance;  // [m] root mean square, from double
};

/// Root mean square over bodies that move of the way between two sights of them: of six points half a metre from the
/// centre on the body's axes, so that turning counts. Not a number where there are not the same bodies.
double distance_between(const scenes::Sight& a, const scenes::Sight& b);

/// Weightless, a box that turns about its middle axis, nearly: it turns over and over.
scenes::Scene spinner();

/// A chain that hangs, one that swings, a spinner and a pile, by soft step at each scene's own sub-steps, in every
/// scalar of this build but double. `frames`: at most so many.
std::vector<GrowthSample> measure_growth(int frames);

}  // namespace isostep::tool::lab
