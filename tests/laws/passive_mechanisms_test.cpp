// Laws of mechanisms without motors or springs: nothing drives them, so they never have more energy than they began
// with.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <vector>

#include "random/dice.hpp"
#include "random/energy_book.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace passive_mechanisms_test {

/// Planks of 0.1 kg with a weight in their middle, hung between two fixed points at one height.
struct Bridge {
  int planks;
  double ratio;   // [1] of the weight's mass to a plank's
  double gap;     // [m] from plank to plank
  double plank;   // [m]
  double slack;   // [1] length of ropes, of the gap
  bool is_ropes;  // else balls
};

template <class S> class PassiveMechanisms : public ::testing::Test {
 protected:
  static void add(World<S>& w, const Bridge& bridge) {
    BodyId last;
    double x = 0;
    const auto tie = [&](BodyId next) {
      TwoPointJoint<S> ends;
      ends.a = last;
      ends.b = next;
      ends.anchor_a = vec<S>(x, 0, 0);
      ends.anchor_b = vec<S>(x + bridge.gap, 0, 0);
      ends.length = num<S>(bridge.gap * bridge.slack);
      const Pose<S> middle = {vec<S>(x + bridge.gap / 2, 0, 0), Quat<Unit<S>>::identity()};
      if (bridge.is_ropes) ASSERT_TRUE(w.create(rope<S>(ends)));
      else ASSERT_TRUE(w.create(w.joint_at(JointType::ball, last, next, middle)));
      x += bridge.gap;
    };
    for (int i = 0; i < bridge.planks; ++i) {
      const bool is_weight = i == bridge.planks / 2;
      const double half = is_weight ? 0.1 : bridge.plank / 2, thin = std::max(1.0 / 64, bridge.plank / 8);
      const ShapeId shape = is_weight ? add_ball(w, half) : add_box(w, half, thin, thin);
      BodyDefinition<S> d = moving<S>(shape, {x + bridge.gap + half, 0, 0});
      d.mass = num<S>(is_weight ? 0.1 * bridge.ratio : 0.1);
      d.collide = false;
      const BodyId next = w.create(d);
      tie(next);
      last = next;
      x += 2 * half;
    }
    tie({});
  }
  /// [1] The most above the start, of the weight times the span.
  static double gain_of(const Bridge& bridge, double seconds) {
    World<S> w(settings<S>());
    add(w, bridge);
    const double start = EnergyBook<S>::energy_of(w);
    double most = start;
    for (int i = 0; i < seconds * 60; ++i) {
      w.step();
      most = std::max(most, EnergyBook<S>::energy_of(w));
    }
    const double span = bridge.planks * bridge.plank + (bridge.planks + 1) * bridge.gap;
    return (most - start) / (0.1 * (bridge.ratio + bridge.planks) * 10 * span);
  }
};
TYPED_TEST_SUITE(PassiveMechanisms, AllScalars);

TYPED_TEST(PassiveMechanisms, bridges_gain_nothing) {
  Dice dice(17);
  constexpr double kGaps[] = {0.02, 0.1, 0.3}, kRatios[] = {1, 10, 100, 500};
  const int bridges = sampled(128, 32);
  for (int i = 0; i < bridges; ++i) {
    Bridge bridge;
    bridge.planks = 3 + 2 * static_cast<int>(dice.below(6));
    bridge.ratio = kRatios[dice.below(std::is_same_v<TypeParam, Q16_16> ? 2 : 4)];
    bridge.gap = kGaps[dice.below(3)];
    bridge.plank = dice.in(0.1, 0.5);
    bridge.slack = i % 2 == 0 ? 1 : 1.1;
    bridge.is_ropes = i % 4 != 3;
    EXPECT_LT(this->gain_of(bridge, 6), pick<TypeParam>(0.002, 0.002, 0.02, 0.002))
        << bridge.planks << " planks of " << bridge.plank << " m, 1:" << bridge.ratio << ", gaps of " << bridge.gap
        << " m, slack " << bridge.slack << (bridge.is_ropes ? ", ropes" : ", balls");
  }
}

}  // namespace passive_mechanisms_test
}  // namespace isostep::test
