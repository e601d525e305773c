// Laws of what spins and strikes: contacts take energy from rods, needles and plates at hundreds of radians a second.
// Their inertia about the world's axes turns over within one step: it was kept, and a rod left a floor with a hundred
// thousand times the energy that it came with.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "random/dice.hpp"
#include "random/energy_book.hpp"

namespace isostep::test {
namespace spinning_test {

/// A drop from a metre above the ground at 10 m/s, spinning about any axis.
struct Drop {
  SolverName solver = SolverName::soft_step;
  int substeps = 8;
  double spin = 300;  // [rad/s]
  double friction = 0.5, restitution = 0;
  bool on_box = false;
};

template <class S> class Spinning : public ::testing::Test {
 protected:
  static constexpr int kDrops = 12, kFrames = 90;

  static BodyId add_floor(World<S>& w, const Drop& drop) {
    BodyDefinition<S> d = still<S>(ShapeId{});
    if (drop.on_box) d = still<S>(add_box(w, 20, 1, 20), {0, -1, 0});
    else d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
    d.material.friction = num<S>(drop.friction);
    d.material.restitution = num<S>(drop.restitution);
    return w.create(d);
  }
  /// [1] The most that it has above the least that it ever had, of what it had above the ground at the start.
  static double gain_of(const Drop& drop, D3 half, std::uint64_t seed) {
    Settings<S> s = settings<S>(-10, 60, drop.substeps);
    s.solver = drop.solver;
    s.allow_sleep = false;
    World<S> w(s);
    add_floor(w, drop);
    Dice dice(seed);
    BodyDefinition<S> d = moving<S>(add_box(w, half.x, half.y, half.z), {0, 1, 0}, {0, -10, 0});
    d.mass = S(1);
    d.orientation = dice.orientation<S>();
    d.angular_velocity = vec<S>(dice.direction() * drop.spin);
    d.material.friction = num<S>(drop.friction);
    EXPECT_TRUE(w.create(d));
    const double start = EnergyBook<S>::energy_of(w);
    double least = start, gain = 0;
    for (int i = 0; i < kFrames; ++i) {
      w.step();
      const double now = EnergyBook<S>::energy_of(w);
      gain = std::max(gain, now - least);
      least = std::min(least, now);
    }
    return gain / start;
  }
  /// The worst of many drops of a rod, a needle, a slab and a plate. Those of less than a centimetre are too small for
  /// Q16.16, and so is what turns faster than 64 rad/s.
  static void expect_no_gain(Drop drop, double bar) {
    const double thin = pick<S>(0.0098, 0.0098, 0.0625, 0.0098);
    if (std::is_same_v<S, Q16_16>) drop.spin = std::min(drop.spin, 55.0);
    const D3 halves[] = {{0.5, thin, thin}, {thin, 0.25, thin}, {0.3, thin, 0.2}, {0.5, 2 * thin, 0.5}};
    for (const D3 half : halves) {
      double worst = 0;
      for (std::uint64_t seed = 0; seed < kDrops; ++seed) worst = std::max(worst, gain_of(drop, half, seed));
      EXPECT_LT(worst, bar) << "half extents " << half.x << ' ' << half.y << ' ' << half.z << ", "
                            << kSolverNames[static_cast<int>(drop.solver)] << ", " << drop.spin << " rad/s, friction "
                            << drop.friction;
    }
  }
};
TYPED_TEST_SUITE(Spinning, AllScalars);

// [1] The gain of energy by the push that parts overlaps; a drop without a spin gains 0.05. Without friction a rod
// rattles on its ends for seconds, and gains as much again and again.
constexpr double kBar = 0.1, kPlaneBar = 0.15, kFrictionlessBar = 0.5;

TYPED_TEST(Spinning, what_strikes_a_plane_gains_nothing) {
  for (const double spin : {100.0, 200.0, 300.0, 400.0}) {
    Drop drop;
    drop.spin = spin;
    this->expect_no_gain(drop, kPlaneBar);
    drop.friction = 0;
    this->expect_no_gain(drop, kFrictionlessBar);
  }
}
TYPED_TEST(Spinning, what_bounces_gains_nothing) {
  Drop drop;
  drop.restitution = 0.5;
  this->expect_no_gain(drop, kBar);
}
TYPED_TEST(Spinning, what_strikes_a_box_gains_nothing) {
  Drop drop;
  drop.on_box = true;
  this->expect_no_gain(drop, kBar);
}
TYPED_TEST(Spinning, few_sub_steps_do_nearly_as_well) {
  Drop drop;
  drop.substeps = 4;
  drop.spin = 200;
  this->expect_no_gain(drop, 4 * kBar);
}
TYPED_TEST(Spinning, other_solvers_do_as_well) {
  for (const SolverName solver : all_but({SolverName::soft_step, SolverName::avbd})) {
    Drop drop;
    drop.solver = solver;
    this->expect_no_gain(drop, kBar);
  }
}

/// What turns by more than a radian a sub-step is slowed before it turns, and that is reported.
TYPED_TEST(Spinning, what_a_blow_spins_beyond_the_limit_is_slowed_and_reported) {
  using S = TypeParam;
  if (std::is_same_v<S, Q16_16>) return;  // its limit is lower, and met at once
  World<S> w(settings<S>(0, 60, 1));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.0625, 0.0625), {0, 0, 0});
  const BodyId rod = w.create(d);
  ASSERT_TRUE(w.apply_impulse_at(rod, vec<S>(0, 0, 20 * to_double(w.mass(rod))), vec<S>(0.5, 0, 0)));
  EXPECT_EQ(w.step().clamped_speed, 1u);
  EXPECT_LE(length(real(w.angular_velocity(rod))), 60 * (1 + 1e-3));
}

/// What is taken back of a push, for the gyroscopic term, grows with the square of the speed before it: of a body that
/// damping all but stops within a sub-step it was more than all that is left, and grew until it was no number.
TYPED_TEST(Spinning, what_damping_stops_gains_nothing) {
  using S = TypeParam;
  const double blow = pick<S>(300, 300, 30, 300);  // [N m s] hundreds of rad/s; tens, of the most that Q16.16 has
  for (const double damping : {50.0, 500.0, 16384.0}) {
    for (const int substeps : {1, 8, 64}) {
      SCOPED_TRACE(testing::Message() << "damping " << damping << ", sub-steps " << substeps);
      World<S> w(settings<S>(0, 10, substeps));
      BodyDefinition<S> d = moving<S>(add_box(w, 1, 0.5, 0.25), {0, 0, 0});
      d.mass = S(1);
      d.angular_damping = num<S>(damping);
      const BodyId box = w.create(d);
      for (int i = 0; i < 30; ++i) {
        if (i % 3 == 1) {
          ASSERT_TRUE(w.apply_impulse(box, vec<S>(0, 0, 0), vec<S>(0, blow, 0.25 * blow)));
        }
        const double before = EnergyBook<S>::energy_of(w);
        EXPECT_EQ(w.step().stopped, 0u);
        EXPECT_LE(EnergyBook<S>::energy_of(w), before * (1 + 1e-3)) << "step " << i;
        if (i % 3 == 1) {
          EXPECT_GT(before, 100);
        }
      }
    }
  }
}

}  // namespace spinning_test
}  // namespace isostep::test
