// Laws of many bounces: a gas without losses keeps its energy, small boxes that rest stand.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace many_contacts_test {

template <class S> class ManyContacts : public ::testing::Test {
 protected:
  struct Kept {
    double least_left, most;  // [1] of the energy in the beginning
  };
  /// Thirty balls of 0.25 m in a cube of six metres, all as elastic as the walls and without friction, for a minute.
  static Kept kept(SolverName solver, double speed) {
    Settings<S> s = settings<S>(0);
    s.solver = solver;
    World<S> w(s);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Vec3<Unit<S>> normal = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};
        normal[axis] = Unit<S>(side);
        BodyDefinition<S> wall = still<S>(w.add_shape(HalfSpace<S>{normal, S(-3)}));
        wall.material.friction = S(0);
        wall.material.restitution = S(1);
        w.create(wall);
      }
    }
    const ShapeId ball = add_ball(w, 0.25);
    std::vector<BodyId> balls;
    Dice dice(1);
    for (int i = 0; i < 30; ++i) {
      BodyDefinition<S> d =
          moving<S>(ball, {1.35 * (i % 4) - 2.1, 1.35 * (i / 4 % 4) - 2.1, 1.35 * (i / 16) - 2.1}, dice.point(speed));
      d.mass = S(1);
      d.material.friction = S(0);
      d.material.restitution = S(1);
      balls.push_back(w.create(d));
    }
    const auto energy = [&] {
      double sum = 0;
      for (const BodyId id : balls) sum += std::pow(length(real(w.velocity(id))), 2) / 2;
      return sum;
    };
    const double start = energy();
    Kept found = {1, 1};
    for (int i = 0; i < 3600; ++i) {
      w.step();
      found.most = std::max(found.most, energy() / start);
    }
    found.least_left = energy() / start;
    return found;
  }
};
TYPED_TEST_SUITE(ManyContacts, AllScalars);

// Each bounces in the sub-step in which it meets; what is lost are meetings below a sixteenth of the threshold.
TYPED_TEST(ManyContacts, of_elastic_balls_keeps_most_of_its_energy_for_a_minute) {
  for (const double speed : {1.0, 3.0}) {
    const auto soft = this->kept(SolverName::soft_step, speed);
    EXPECT_GT(soft.least_left, 0.98) << speed;
    EXPECT_LT(soft.most, 1.005) << speed;
    if (!kHasBook) continue;
    const auto book = this->kept(SolverName::worst_first, speed);
    EXPECT_GT(book.least_left, 0.98) << speed;
    EXPECT_LT(book.most, 1.005) << speed;
  }
}

// Bodies rest a little inside each other, 0.3 mm here and as much where they are smaller. So limits.hpp says from which
// size on stacks stand.
TYPED_TEST(ManyContacts, four_boxes_of_three_centimetres_stand) {
  using S = TypeParam;
  const double half = 1.0 / 64;
  for (const int substeps : {4, 8}) {
    World<S> w(settings<S>(-10, 60, substeps));
    add_ground(w);
    const ShapeId box = add_box(w, half, half, half);
    std::vector<BodyId> boxes;
    for (int i = 0; i < 4; ++i) boxes.push_back(w.create(moving<S>(box, {0, half + 2 * half * i, 0})));
    for (int i = 0; i < 1200; ++i) w.step();
    for (int i = 0; i < 4; ++i) {
      const D3 at = real(w.center_of_mass(boxes[static_cast<std::size_t>(i)]));
      EXPECT_NEAR(at.y, half + 2 * half * i, 0.25 * half) << substeps;
      EXPECT_LT(std::hypot(at.x, at.z), 0.1 * half) << substeps;
    }
  }
}

}  // namespace many_contacts_test
}  // namespace isostep::test
