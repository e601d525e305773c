// PairsApart: the judge of pairs that begin inside one another.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "judges.hpp"
#include "scene_numbers.hpp"

namespace isostep::scenes {

/// Bodies come in pairs, one after the other. Greatest speed of any over 3 m/s, or what two centres lack at the end of
/// the least distance at which the pair can be apart, over 5 % of that: the larger.
class PairsApart : public Judge {
 public:
  explicit PairsApart(const Scene& scene) {
    for (std::size_t i = 0; i + 1 < scene.bodies.size(); i += 2) {
      least_.push_back(least_reach(scene.bodies[i]) + least_reach(scene.bodies[i + 1]));
    }
  }
  void see(const Sight& sight) override {
    constexpr double kPush = 3, kLeft = 0.05;  // [m/s], [1]
    for (const BodySight& body : sight.bodies) speed_ = worse(speed_, length_of(body.velocity) / kPush);
    left_ = 0;
    for (std::size_t i = 0; i < least_.size(); ++i) {
      const double distance = length_of(sight.bodies[2 * i + 1].centre - sight.bodies[2 * i].centre);
      left_ = worse(left_, (1 - distance / least_[i]) / kLeft);
    }
  }
  double figure() const override { return worse(speed_, left_); }

 private:
  std::vector<double> least_;  // [m]
  double speed_ = 0, left_ = 0;
};

}  // namespace isostep::scenes
