// Random articulations: energy and momentum are bounded, states come back bit for bit, from snapshots and from files.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "isostep/state/concepts.hpp"
#include "random/articulation.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace random_articulations_test {

static_assert(Rollbackable<Articulation<float>> && Rollbackable<Articulation<double>>);
static_assert(Rollbackable<Articulation<Q32_32>> && PortableState<Articulation<Q32_32>>);

template <class S> class RandomArticulations : public ::testing::Test {
 protected:
  const unsigned kTrees = sampled(40u, 12u);

  /// The largest share of the most kinetic energy that energy ever rose by above what it was at first.
  static double gain(const TreeOptions& options, unsigned seed, double fast, int frames) {
    TreeDice dice(seed);
    ArticulationDefinition<S> definition = dice.tree<S>(options);
    Articulation<S> a = built(definition);
    dice.set_going(a, fast);
    const double start = motion_of(a).energy();
    double scale = 1, top = 0;
    for (int i = 0; i < frames; ++i) {
      const ArticulationReport report = a.step();
      EXPECT_EQ(report.clamped + report.lost, 0u) << seed;
      const Motion now = motion_of(a);
      scale = std::max(scale, now.kinetic);
      top = std::max(top, now.energy() - start);
    }
    return top / scale;
  }
  /// Something new each frame: drives, forces, places.
  static void command(Articulation<S>& a, TreeDice& dice) {
    const std::uint32_t link = static_cast<std::uint32_t>(dice.below(static_cast<int>(a.links())));
    const ArticulationJoint type = a.definition().links[link].type;
    const bool moves = type != ArticulationJoint::fixed && type != ArticulationJoint::free;
    const ArticulationDrive<S> drive = dice.drive<S>();
    const D3 force = dice.point(20);
    const D3 aside = dice.point(0.5);
    const int what = dice.below(4);
    if (what == 0 && moves) {
      EXPECT_TRUE(a.set_drive(link, drive)) << describe(a.fault());
    } else if (what == 1) {
      EXPECT_TRUE(a.apply_force(link, vector<S>(force), a.link_centre(link) + vector<S>(aside)));
    } else if (what == 2) {
      EXPECT_TRUE(a.apply_torque(link, vector<S>(force)));
    }
  }
  static TreeOptions everything(bool free) {
    TreeOptions options;
    options.free = free;
    options.springs = options.limits = options.damping = options.drives = true;
    return options;
  }
};
TYPED_TEST_SUITE(RandomArticulations, ArticulatedScalars);

TYPED_TEST(RandomArticulations, energy_does_not_grow_without_drives) {
  for (unsigned seed = 0; seed < this->kTrees; ++seed) {
    TreeOptions options;
    options.free = seed % 2 == 0;
    EXPECT_LT(this->gain(options, seed, 1, 300), 0.005) << seed;
    options.limits = true;
    EXPECT_LT(this->gain(options, seed, 3, 300), 0.005) << seed;
    options.damping = options.springs = true;
    EXPECT_LT(this->gain(options, seed, 3, 300), 0.02) << seed;  // springs as fast as sub-steps swing by their error
  }
}

TYPED_TEST(RandomArticulations, free_trees_keep_momentum_whatever_their_joints_do) {
  using S = TypeParam;
  for (unsigned seed = 0; seed < this->kTrees; ++seed) {
    TreeDice dice(seed);
    TreeOptions options = this->everything(true);
    options.gravity = false;
    Articulation<S> a = built(dice.tree<S>(options));
    dice.set_going(a, 2);
    const Motion start = motion_of(a);
    double most = 1;
    for (int i = 0; i < 300; ++i) {
      a.step();
      most = std::max(most, motion_of(a).kinetic);
    }
    const Motion end = motion_of(a);
    const double tolerance = by_scalar<S>(1e-3, 1e-9, 1e-5) * (1 + std::sqrt(most));
    EXPECT_LT(size(end.momentum - start.momentum), tolerance) << seed;
    EXPECT_LT(size(end.angular_about_centre() - start.angular_about_centre()), tolerance) << seed;
  }
}

TYPED_TEST(RandomArticulations, a_state_that_comes_back_has_the_same_future) {
  using S = TypeParam;
  for (unsigned seed = 0; seed < this->kTrees; ++seed) {
    TreeDice dice(seed);
    Articulation<S> a = built(dice.tree<S>(this->everything(seed % 2 == 0)));
    dice.set_going(a, 2);
    for (int i = 0; i < 20; ++i) {
      this->command(a, dice);
      a.step();
    }
    this->command(a, dice);  // a force that waits for its step is state
    Snapshot<Articulation<S>> kept;
    a.save(kept);
    std::vector<std::uint8_t> bytes;
    Writer writer(bytes);
    a.write_portable(writer);
    const std::uint64_t here = a.hash();
    std::vector<std::uint64_t> hashes;
    const auto run = [&](Articulation<S>& tree, auto&& at_frame) {
      TreeDice commands(seed + 1000);
      for (int i = 0; i < 40; ++i) {
        this->command(tree, commands);
        tree.step();
        at_frame(static_cast<std::size_t>(i), tree.hash());
      }
    };
    run(a, [&](std::size_t, std::uint64_t hash) { hashes.push_back(hash); });
    const auto same = [&](std::size_t i, std::uint64_t hash) { ASSERT_EQ(hash, hashes[i]) << seed << ' ' << i; };
    a.load(kept);
    ASSERT_EQ(a.hash(), here);
    run(a, same);
    Articulation<S> other;  // that never was this tree
    other.load(kept);
    run(other, same);
    Articulation<S> read;
    Reader reader(bytes);
    const Result<void> result = read.read_portable(reader);
    ASSERT_TRUE(result.ok()) << result.error().message.view();
    ASSERT_EQ(read.hash(), here);
    run(read, same);
  }
}

// Motors that pull with a thousand newton metres at a kilogram, against limits: nothing passes them, nothing is lost.
TYPED_TEST(RandomArticulations, limits_hold_what_is_driven_hard) {
  using S = TypeParam;
  for (unsigned seed = 0; seed < this->kTrees; ++seed) {
    TreeDice dice(seed);
    TreeOptions options = this->everything(seed % 2 == 0);
    ArticulationDefinition<S> d = dice.tree<S>(options);
    for (ArticulationLink<S>& l : d.links) {
      if (l.type == ArticulationJoint::fixed || l.type == ArticulationJoint::free) continue;
      l.limited = true;
      l.upper = number<S>(0.6);
      l.lower = l.type == ArticulationJoint::ball ? S(0) : number<S>(-0.6);
      l.rest = S(0);
      l.drive.damping = number<S>(dice.in(1, 1e4));
      l.drive.speed = vector<S>(dice.point(100));
      l.drive.max_force = number<S>(1000);
    }
    Articulation<S> a = built(d);
    for (int i = 0; i < 120; ++i) {
      const ArticulationReport report = a.step();
      ASSERT_EQ(report.lost, 0u) << seed;
      for (std::uint32_t k = 0; k < a.links(); ++k) {
        const ArticulationLink<S>& l = d.links[k];
        if (l.type != ArticulationJoint::hinge && l.type != ArticulationJoint::slider) continue;
        ASSERT_LT(std::fabs(to_double(a.coordinates(k).position.x)), 0.6 + 1e-3) << seed << ' ' << k;
      }
      const double kinetic = motion_of(a).kinetic;
      ASSERT_TRUE(kinetic < 1e7) << seed << ' ' << i << ' ' << kinetic;
    }
  }
}

}  // namespace random_articulations_test
}  // namespace isostep::test
