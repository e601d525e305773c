// Nets of ball joints, which are full of loops, hang still and swing without gaining energy.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "random/energy_book.hpp"

namespace isostep::test {
namespace joint_nets_test {

template <class S> class JointNets : public ::testing::Test {
 protected:
  /// Columns a metre apart that hang on the world, and rungs between them.
  void hang(int rows, int columns) {
    const ShapeId ball = add_ball(w, 0.4);
    for (int k = 0; k < columns; ++k) {
      for (int i = 0; i < rows; ++i) {
        BodyDefinition<S> d = moving<S>(ball, {double(k), -double(i), 0});
        d.mass = S(1);
        d.collide = d.allow_sleep = false;
        net.push_back(w.create(d));
        const auto tie = [&](BodyId to, D3 at) {
          const Pose<S> frame = {vec<S>(at), Quat<Unit<S>>::identity()};
          ASSERT_TRUE(w.create(w.joint_at(JointType::ball, to, net.back(), frame)));
        };
        tie(i > 0 ? net[net.size() - 2] : BodyId{}, {double(k), 0.5 - i, 0});
        if (k > 0) tie(net[net.size() - 1 - static_cast<std::size_t>(rows)], {k - 0.5, -double(i), 0});
      }
    }
  }
  World<S> w{settings<S>(-10)};
  std::vector<BodyId> net;
};
TYPED_TEST_SUITE(JointNets, AllScalars);

/// After one relaxation it swung at 10 m/s two seconds later.
TYPED_TEST(JointNets, hang_still) {
  this->hang(8, 6);
  std::vector<D3> at;
  for (const BodyId id : this->net) at.push_back(real(this->w.center_of_mass(id)));
  run(this->w, 300);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_LT(length(real(this->w.center_of_mass(this->net[i])) - at[i]), 0.01) << i;
    EXPECT_LT(length(real(this->w.velocity(this->net[i]))), 0.01) << i;
  }
}

TYPED_TEST(JointNets, gain_nothing_while_they_swing) {
  using S = TypeParam;
  this->hang(5, 4);
  for (const BodyId id : this->net) this->w.set_velocity(id, vec<S>(0.4, 0, 0.4), vec<S>(0, 0, 0));
  run(this->w, 10);  // until the kick, which no joint allows, has spread
  const double start = EnergyBook<S>::energy_of(this->w);
  double most = start;
  for (int i = 0; i < 300; ++i) {
    this->w.step();
    most = std::max(most, EnergyBook<S>::energy_of(this->w));
  }
  EXPECT_LT(most - start, 0.02);  // [J] of 1.2 J of motion
}

}  // namespace joint_nets_test
}  // namespace isostep::test
