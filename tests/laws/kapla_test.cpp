// A tower of 102 blocks in twelve layers, each of which bears on eight edges or nine flat sides: it stands with four
// sub-steps. SimBenchmark's kapla tower, of blocks of 10 kg. ISOSTEP_KAPLA=1 tries ten minutes: Q16.16 falls then.
// Source:  Hwangbo, Lee, Hutter 2018, SimBenchmark.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "random/asked.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace kapla_test {

template <class S> class Kapla : public ::testing::Test {
 protected:
  /// up: 1 for y, 2 for z.
  static D3 stood(D3 at, int up) { return up == 1 ? at : D3{at.x, at.z, at.y}; }
  static BodyDefinition<S> block(ShapeId shape, D3 at, int up) {
    BodyDefinition<S> d = moving<S>(shape, stood(at, up));
    d.mass = S(10);
    d.material.friction = num<S>(0.8);
    return d;
  }
  static void expect_to_stand(int hz, int up) {
    Settings<S> s = settings<S>(0, hz, 4);
    s.gravity = vec<S>(stood({0, -9.81, 0}, up));
    s.allow_sleep = false;
    World<S> w(s);
    const auto shape = [&](D3 half) {
      const D3 h = stood(half, up);
      return add_box(w, h.x, h.y, h.z);
    };
    BodyDefinition<S> ground = still<S>(shape({20, 1, 20}), stood({0, -1, 0}, up));
    ground.material.friction = num<S>(0.8);
    w.create(ground);
    const ShapeId across = shape({0.025, 0.05, 0.125}), along = shape({0.1, 0.05, 0.025});
    std::vector<BodyId> blocks;
    for (int layer = 0; layer < 12; ++layer) {
      const double height = 0.05 + 0.1 * layer;
      if (layer % 2 == 0) {
        for (int i = 0; i < 8; ++i) blocks.push_back(w.create(block(across, {0.2 * i, height, 0}, up)));
        continue;
      }
      for (const double x : {0.1, 0.5, 0.9, 1.3}) blocks.push_back(w.create(block(along, {x, height, 0.1}, up)));
      for (const double x : {0.3, 0.7, 1.1, 0.1, 1.3}) blocks.push_back(w.create(block(along, {x, height, -0.1}, up)));
    }
    ASSERT_EQ(blocks.size(), 102u);
    run(w, asked("ISOSTEP_KAPLA", 0) > 0 ? 600 * hz : 600);
    double fastest = 0;
    for (const BodyId id : blocks) fastest = std::max(fastest, length(real(w.velocity(id))));
    const D3 top = stood(real(w.center_of_mass(blocks.back())), up);
    expect_near(top, {1.3, 1.15, -0.1}, 0.02, "top");
    EXPECT_LT(fastest, pick<S>(0.01, 0.01, 0.02, 0.01)) << hz << " Hz, up " << up << ": before it fell it swayed";
  }
};
TYPED_TEST_SUITE(Kapla, AllScalars);

/// It fell after 2000 to 7400 frames, and swayed by cm/s before.
TYPED_TEST(Kapla, stands_on_four_substeps) {
  for (const int hz : {60, 100}) {
    for (const int up : {1, 2}) this->expect_to_stand(hz, up);
  }
}

}  // namespace kapla_test
}  // namespace isostep::test
