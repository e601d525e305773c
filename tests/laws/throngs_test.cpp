// Bodies that begin in one place leave it without harm, and a step does not look at each with each.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>

#include "random/dice.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace throngs_test {

template <class S> class Throngs : public ::testing::Test {
 protected:
  static constexpr std::size_t kCount = 200;

  static ShapeId add_shape(World<S>& w, std::uint32_t kind, double size) {
    switch (kind) {
      case 0: return add_ball(w, size);
      case 1: return add_box(w, size, size, size);
      case 2: return w.add_shape(Capsule<S>{num<S>(size / 2), num<S>(size / 2)});
      default: return w.add_shape(Cylinder<S>{num<S>(size), num<S>(size)});
    }
  }
  /// kind 4: of all. `apart` [m] at most. [m/s] The fastest of a second and a half.
  static double leave(std::uint32_t kind, double size, double apart, std::uint64_t seed) {
    Dice dice(seed);
    World<S> w(settings<S>(-10, 60, 4));
    w.create(still<S>(add_box(w, 60, 0.5, 60), {0, -0.5, 0}));
    std::array<ShapeId, 4> shapes;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) shapes[i] = add_shape(w, i, size);
    std::vector<BodyId> bodies;
    for (std::size_t i = 0; i < kCount; ++i) {
      const D3 at = apart == 0 ? D3{0, 0, 0} : dice.arrow(0, apart);
      bodies.push_back(w.create(moving<S>(shapes[kind < 4 ? kind : i % 4], at + D3{0, 4, 0})));
    }
    double fastest = 0;
    for (int step = 0; step < 90; ++step) {
      w.step();
      if (step == 0) {
        EXPECT_LT(w.counts().contacts, 8 * kCount) << "kind " << kind;
      }
      for (const BodyId id : bodies) {
        fastest = std::max(fastest, length(real(w.velocity(id))));
        EXPECT_GT(real(w.pose(id).position).y, 0) << "kind " << kind;
      }
    }
    return fastest;
  }
};
TYPED_TEST_SUITE(Throngs, AllScalars);

TYPED_TEST(Throngs, of_every_kind_come_apart_below_twenty_metres_a_second) {
  const auto scalar = static_cast<std::uint32_t>(pick<TypeParam>(0, 1, 2, 3));
  for (std::uint32_t kind = 0; kind < 5; ++kind) {
    if (!wants_whole() && kind % 4 != scalar) continue;  // of a sample each in one scalar
    EXPECT_LT(this->leave(kind, 0.5, 0, kind), 20) << "kind " << kind;
  }
  EXPECT_LT(this->leave(4, 0.25, 0.01, 10), 20);
}

}  // namespace throngs_test
}  // namespace isostep::test
