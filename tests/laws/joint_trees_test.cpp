// Laws of random joints and trees of joints of every kind, by themselves, for ten seconds: no more energy than they
// were given, joints together, limits held, momentum kept.
// ISOSTEP_RANDOM_JOINTS=4800 tries so many single joints and ISOSTEP_RANDOM_TREES=2000 so many trees with every solver,
// and prints the worst of each; without them a few are tried.
// SPDX-License-Identifier: MIT

#include "laws/joint_trees.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <sstream>

#include "random/asked.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace joint_trees_test {

struct JointTreeBars {
  double energy;  // [1]
  double place;   // [m]
  double angle;   // [rad]
  double past;    // [m] or [rad]
  double drift;   // [m/s]
};
/// Energy: as of random worlds; of the first 160 joints the worst has 0.068. Place and limits: those
/// of ragdolls with limits (scene S20). Drift: 600 steps of rounding in Q16.16.
constexpr JointTreeBars kHeld = {0.1, 0.05, 0.05, 0.15, 0.01};
/// One joint solved sixty times a second gives by 44 mm.
constexpr JointTreeBars kHeldBySweeps = {0.1, 0.1, 0.1, 0.15, 0.01};
/// Many that are solved one after another: by pgs, and in Q16.16 by soft_step where masses are more than 64 apart.
constexpr JointTreeBars kSwept = {0.1, 0.5, 0.5, 0.5, 0.01};
template <class S> constexpr JointTreeBars bars_of(const JointTreeTrial& trial) {
  if (trial.solver == SolverName::pgs) return trial.single ? kHeldBySweeps : kSwept;
  const bool sweeps = std::is_same_v<S, Q16_16> && trial.solver == SolverName::soft_step && !trial.single;
  return sweeps ? kSwept : kHeld;
}

/// Seeds that soft_step lost once: springs that followed the mass which they felt, twists that came back beyond their
/// limit from half a turn of swing; trees with more than eight blocks at a body; a motor at the speed of another one
/// that is off; and 280 kg on a light body's long arm.
constexpr int kOnceLostJoints[] = {784, 790, 841, 1312, 1598, 1950, 2774, 2877, 3615, 4458};
constexpr int kOnceLostTrees[] = {15, 42, 52, 80, 124, 137, 501, 1850};
/// Not mended: Q16.16 solves trees one joint after another whose masses are more than 64 apart, and sixty times a
/// second is too seldom for that. These gain energy or come apart with pgs. Of soft_step, a stop takes 60 kg through a
/// body of 2 kg in 52, whose speed the format cuts for one sub-step; 80 passes a limit by 0.51.
constexpr int kLostOfPgsInQ16[] = {6, 7, 8, 10};
constexpr int kLostOfSoftStepInQ16[] = {52, 80};

template <class S> class JointTreeLaws : public ::testing::Test {
 protected:
  static void try_all(const JointTreeTrial& trial) {
    const int all = static_cast<int>(asked(trial.single ? "ISOSTEP_RANDOM_JOINTS" : "ISOSTEP_RANDOM_TREES", 0));
    std::vector<int> seeds = seeds_of(trial, all);
    if (all == 0) std::erase_if(seeds, [&](int seed) { return is_known(trial, seed); });
    const int count = static_cast<int>(seeds.size());
    const JointTreeBars bars = bars_of<S>(trial);
    JointTreeFindings most;
    std::ostringstream lost;
    int found = 0, tried = 0;
    for (const int seed : seeds) {
      const JointTreeFindings f = try_joint_tree<S>(static_cast<std::uint64_t>(seed), trial);
      tried += f.made ? 1 : 0;
      most += f;
      if (is_within(f, bars)) continue;
      ++found;
      lost << "\n  seed " << seed << ": " << words(f);
    }
    if (all > 0) {
      std::printf("%s %s, %d of %d %s, %d beyond the bars: %s\n", ScalarTraits<S>::kName,
                  kSolverNames[static_cast<int>(trial.solver)], tried, count, trial.single ? "joints" : "trees", found,
                  words(most).c_str());
      std::fflush(stdout);
    }
    EXPECT_EQ(found, 0) << "of " << tried << lost.str();
    EXPECT_GT(tried, count / 2);
  }

 private:
  static int seeds_of_kind(bool single) { return single ? sampled(48, 12) : sampled(12, 3); }

  static bool is_known(const JointTreeTrial& trial, int seed) {
    if (!std::is_same_v<S, Q16_16> || trial.single || trial.solver == SolverName::direct) return false;
    const bool pgs = trial.solver == SolverName::pgs;
    const std::span<const int> known = pgs ? std::span<const int>(kLostOfPgsInQ16) : kLostOfSoftStepInQ16;
    return std::count(known.begin(), known.end(), seed) > 0;
  }
  static std::vector<int> seeds_of(const JointTreeTrial& trial, int all) {
    std::vector<int> seeds;
    for (int seed = 0; seed < (all > 0 ? all : seeds_of_kind(trial.single)); ++seed) seeds.push_back(seed);
    if (all > 0 || trial.solver != SolverName::soft_step) return seeds;
    const std::span<const int> lost = trial.single ? std::span<const int>(kOnceLostJoints) : kOnceLostTrees;
    const auto scalar = static_cast<std::size_t>(pick<S>(0, 1, 2, 3));
    for (std::size_t i = 0; i < lost.size(); ++i) {
      if (wants_whole() || i % 4 == scalar) seeds.push_back(lost[i]);  // of a sample, each in one scalar
    }
    return seeds;
  }
  static bool is_within(const JointTreeFindings& f, const JointTreeBars& bars) {
    return f.energy <= bars.energy && f.place <= bars.place && f.angle <= bars.angle && f.past <= bars.past &&
           f.drift <= bars.drift && f.faults == 0;
  }
  static std::string words(const JointTreeFindings& f) {
    std::ostringstream said;
    said << "energy above its bound by " << f.energy << " of what moved it, " << f.place << " m and " << f.angle
         << " rad apart, " << f.past << " past a limit, drift " << f.drift << " m/s, " << f.faults << " faults";
    return said.str();
  }
};
TYPED_TEST_SUITE(JointTreeLaws, AllScalars);

TYPED_TEST(JointTreeLaws, soft_step_holds_single_joints) { this->try_all({SolverName::soft_step, true}); }
TYPED_TEST(JointTreeLaws, pgs_holds_single_joints) { this->try_all({SolverName::pgs, true}); }
TYPED_TEST(JointTreeLaws, direct_holds_single_joints) { this->try_all({SolverName::direct, true}); }
TYPED_TEST(JointTreeLaws, soft_step_holds_trees) { this->try_all({SolverName::soft_step, false}); }
TYPED_TEST(JointTreeLaws, pgs_holds_trees) { this->try_all({SolverName::pgs, false}); }
TYPED_TEST(JointTreeLaws, direct_holds_trees) { this->try_all({SolverName::direct, false}); }

}  // namespace joint_trees_test
}  // namespace isostep::test
