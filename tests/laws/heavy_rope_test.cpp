// A rope of light links that swings a heavy end down from the horizontal never has more energy than it began with.
// SPDX-License-Identifier: MIT
#include "scenes/measure.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace heavy_rope_test {

template <class S> class HeavyRope : public ::testing::Test {
 protected:
  /// [1] The gain of energy, of what the fall can give: the most above the start in half a minute.
  static double gain(SolverName solver, int links, double heavy) {
    Settings<S> s = settings<S>(-10);
    s.solver = solver;
    World<S> w(s);
    BodyId last;
    for (int i = 0; i < links; ++i) {
      BodyDefinition<S> d = moving<S>(add_ball(w, 0.1), {0.5 * (i + 1), 6, 0});
      d.mass = num<S>(i == links - 1 ? heavy : 1);
      d.collide = d.allow_sleep = false;
      const BodyId next = w.create(d);
      EXPECT_TRUE(
          w.create(w.joint_at(JointType::ball, last, next, {vec<S>(0.5 * i, 6, 0), Quat<Unit<S>>::identity()})));
      last = next;
    }
    const double start = scenes::measure_energy(w).total();
    double most = start;
    for (int i = 0; i < 1800; ++i) {
      EXPECT_TRUE(w.step().clean());
      most = std::max(most, scenes::measure_energy(w).total());
    }
    return (most - start) / (heavy * 10 * 0.5 * links);
  }
};
TYPED_TEST_SUITE(HeavyRope, AllScalars);

TYPED_TEST(HeavyRope, gains_nothing_on_its_way_down_and_up) {
  for (const int links : {3, 6}) {
    for (const double heavy : {1.0, 20.0, 50.0})
      EXPECT_LT(this->gain(SolverName::soft_step, links, heavy), 0.01) << links << " links, " << heavy << " kg";
  }
}

}  // namespace heavy_rope_test
}  // namespace isostep::test
