// Rods and ropes between light links hold a heavy weight: at rest without a tremble, swinging without a stretch.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "random/dice.hpp"
#include "random/energy_book.hpp"

namespace isostep::test {
namespace taut_rods_test {

/// Links and a ball at the end, each on a rod or rope, in a line that leans by `angle` from the vertical.
struct Line {
  double ratio;      // [1] of the ball's mass to a link's
  double rod, link;  // [m] lengths
  int links;
  bool ropes;
  double angle;  // [rad]
};
/// Lengths of rods from a centimetre to a metre; every other line hangs at rest.
Line draw_line(std::uint64_t seed, double most_ratio) {
  Dice dice(seed + 7100);
  Line line;
  line.ratio = dice.magnitude(1, most_ratio);
  line.rod = dice.magnitude(0.01, 1);
  line.link = dice.magnitude(0.1, 1);
  line.links = 1 + dice.below(4);
  line.ropes = dice.one_in(2);
  line.angle = seed % 2 == 0 ? 0 : dice.in(0.1, 1.5);
  return line;
}

/// [1] The distance of the ball from where the line ends, of the line; [m/s] the fastest that moves; [1] energy above
/// the start's, of what the line can give.
struct LineFindings {
  double stretch = 0, fastest = 0, gain = 0;
};

template <class S> class TautRods : public ::testing::Test {
 protected:
  static constexpr double kMostRatio = std::is_same_v<S, Q16_16> ? 128 : 4096;
  static constexpr int kLines = 12;

  static LineFindings watch(const Line& line, SolverName solver, int frames) {
    Settings<S> s = settings<S>(-10);
    s.solver = solver;
    s.allow_sleep = false;
    World<S> w(s);
    const D3 along = {std::sin(line.angle), -std::cos(line.angle), 0};
    BodyId last;
    double end = 0;
    for (int i = 0; i <= line.links; ++i) {
      const bool heavy = i == line.links;
      const double half = heavy ? 0.1 : line.link / 2;
      const ShapeId shape = heavy ? add_ball(w, half) : add_box(w, line.link / 8, half, line.link / 8);
      BodyDefinition<S> d = moving<S>(shape, along * (end + line.rod + half));
      d.orientation = turn<S>({0, 0, 1}, line.angle);
      d.mass = num<S>(heavy ? line.ratio : 1);
      d.collide = false;
      const BodyId next = w.create(d);
      TwoPointJoint<S> ends{.a = last, .b = next};
      ends.anchor_a = vec<S>(along * end);
      ends.anchor_b = vec<S>(along * (end + line.rod) + D3{1e-4 * (i % 2), 0, 0});  // not quite straight
      ends.length = num<S>(line.rod);
      EXPECT_TRUE(w.create(line.ropes ? rope<S>(ends) : rod<S>(ends))) << describe(w.fault());
      last = next;
      end += line.rod + (heavy ? half : 2 * half);
    }
    LineFindings found;
    const double start = EnergyBook<S>::energy_of(w);
    for (int i = 0; i < frames; ++i) {
      w.step();
      found.stretch = std::max(found.stretch, length(real(w.center_of_mass(last))) / end - 1);
      found.gain = std::max(found.gain, (EnergyBook<S>::energy_of(w) - start) / (10 * line.ratio * end));
      for (const BodyId id : w.bodies()) found.fastest = std::max(found.fastest, length(real(w.velocity(id))));
    }
    return found;
  }
  static void expect_held(SolverName solver) {
    for (std::uint64_t seed = 0; seed < kLines; ++seed) {
      const Line line = draw_line(seed, kMostRatio);
      SCOPED_TRACE(testing::Message() << "ratio " << line.ratio << ", rods of " << line.rod << " m, " << line.links
                                      << " links of " << line.link << " m at " << line.angle);
      const LineFindings found = watch(line, solver, 180);
      EXPECT_LT(found.stretch, 0.02);
      EXPECT_LT(found.gain, 0.01);
      if (line.angle == 0) {
        EXPECT_LT(found.fastest, 0.2);
      }
    }
  }
};
TYPED_TEST_SUITE(TautRods, AllScalars);

TYPED_TEST(TautRods, hold_what_hangs_and_what_swings) { this->expect_held(SolverName::soft_step); }

/// Fifty kilograms on one link of a hundred grams between rods of five centimetres: it spun at 40 m/s.
TYPED_TEST(TautRods, leave_a_light_link_at_rest) {
  const double ratio = std::min(500.0, this->kMostRatio);
  for (const SolverName solver : {SolverName::soft_step, SolverName::direct}) {
    const LineFindings found = this->watch({ratio, 0.05, 0.3, 1, false, 0}, solver, 300);
    // A step of Q16.16's places is 7 mm/s.
    EXPECT_LT(found.fastest, pick<TypeParam>(0.05, 0.05, 0.1, 0.05)) << kSolverNames[static_cast<int>(solver)];
    EXPECT_LT(found.stretch, pick<TypeParam>(0.002, 0.002, 0.01, 0.002));
  }
}

}  // namespace taut_rods_test
}  // namespace isostep::test
