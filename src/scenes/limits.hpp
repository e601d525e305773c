// The errors of joints past their limits, from what is seen of the bodies alone.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "scene.hpp"
#include "sight.hpp"

namespace isostep::scenes {

/// Knows the scene's hinges and balls that have limits, and how their bodies lay at the start.
class JointLimits {
 public:
  explicit JointLimits(const Scene& scene);
  /// [rad] the furthest that any of them is past a limit; 0 where none is.
  double passed(const std::vector<BodySight>& start, const std::vector<BodySight>& now) const;

 private:
  struct Limited {
    int a, b;  // bodies; -1: the world
    Quat<double> frame;
    bool twists, swings;
    double lower, upper, cone;  // [rad]
  };
  std::vector<Limited> joints_;
};

}  // namespace isostep::scenes
