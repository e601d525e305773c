// A crate that falls onto a slope is alike on both sides of a vertical plane, so nothing may turn it out of that
// plane: all corners of an edge that touch together are stopped together, whatever rounding makes of their gaps. One
// pass over the corners leaves a fifth of the speed at worst, a few hundredths as a rule.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "isostep/geometry/baked/hull_blob.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace plane_falls_test {

template <class S> class PlaneFalls : public ::testing::Test {
 protected:
  /// [1] The speed out of the plane at worst, of the speed of the fall.
  static double out_of_plane(std::uint64_t seed, bool hull) {
    Dice dice(seed);
    World<S> w(settings<S>(-10, 60, 4));
    const double half = dice.magnitude(0.1, 0.5), speed = dice.in(2, 12), lean = dice.in(0.05, 1.2);
    BodyDefinition<S> slope = still<S>(add_box(w, 8, 1, 8));
    slope.orientation = turn<S>({0, 0, 1}, lean);
    slope.material.friction = num<S>(0.6);
    w.create(slope);
    ShapeId shape = add_box(w, half, half, half);
    if (hull) {
      std::vector<D3> corners;
      for (int i = 0; i < 8; ++i)
        corners.push_back({(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half});
      shape = w.add_shape(hull_blob(std::span<const D3>(corners)).value());
    }
    const double rise = 1 / std::cos(lean) + half * (1 + std::tan(lean));
    BodyDefinition<S> cube = moving<S>(shape, {0, rise + speed * dice.in(0.05, 0.2), 0}, {0, -speed, 0});
    cube.material.friction = num<S>(0.6);
    const BodyId id = w.create(cube);
    double worst = 0;
    for (int i = 0; i < 30; ++i) {
      w.step();
      const D3 v = real(w.velocity(id)), spin = real(w.angular_velocity(id));
      worst = std::max({worst, std::fabs(v.z), half * std::fabs(spin.x), half * std::fabs(spin.y)});
    }
    return worst / speed;
  }
};
TYPED_TEST_SUITE(PlaneFalls, AllScalars);

TYPED_TEST(PlaneFalls, of_crates_and_hulls_onto_slopes_stay_in_their_plane) {
  for (const bool hull : {false, true}) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const double out = this->out_of_plane(seed, hull);
      EXPECT_LT(out, 0.25) << seed;
      sum += out;
    }
    EXPECT_LT(sum / 100, 0.04) << hull;
  }
}

}  // namespace plane_falls_test
}  // namespace isostep::test
