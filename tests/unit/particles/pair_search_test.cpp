// The search for pairs: how far particles may come in a step, and what happens beyond the most pairs.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/pair_search.hpp"

#include "unit/particles/room.hpp"

namespace isostep {
namespace {

template <class S> class PairSearchTest : public testing::Test {
 protected:
  Room<S> room_;
  PairSearch<S> search_{room_.state, room_.step};
};
TYPED_TEST_SUITE(PairSearchTest, Scalars);

TYPED_TEST(PairSearchTest, ReachIsTwiceTheWayOfAStep) {
  using S = TypeParam;
  const ParticleId fast = this->room_.add(kNowhere, {0, -30, 0}), slow = this->room_.add(kRight);
  this->room_.begin();
  this->search_.begin_step();
  EXPECT_NEAR(to_double(this->search_.reach_of(fast.slot)), 1, 256 * grain<S>(1));
  EXPECT_NEAR(to_double(this->search_.reach_of(slow.slot)), 2.0 / 60, 256 * grain<S>(1));  // of 1 m/s
}

TYPED_TEST(PairSearchTest, SpringsReachAsFarAsTheyMayPullInAStep) {
  using S = TypeParam;
  const ParticleId a = this->room_.add(kNowhere), b = this->room_.add({3, 0, 0});
  this->room_.state.springs.add(this->room_.spring(a, b, 900, 1));
  this->room_.begin();
  this->search_.begin_step();
  EXPECT_NEAR(to_double(this->search_.reach_of(a.slot)), 2.0 / 60, 256 * grain<S>(1)) << "nothing that it may meet";
  this->room_.make_balls(0.5);
  this->search_.begin_step();
  EXPECT_NEAR(to_double(this->search_.reach_of(a.slot)), 2.0 / 60 + 2 * 900.0 / 3600, 256 * grain<S>(1));
}

TYPED_TEST(PairSearchTest, FindsPairsInReachAscendingAndOnlyWhatWasAdded) {
  using S = TypeParam;
  for (int i = 0; i < 4; ++i) this->room_.add({static_cast<double>(i), 0, 0});
  this->room_.begin();
  this->search_.begin_step();
  this->search_.clear();
  for (const std::uint32_t slot : {0u, 1u, 3u}) this->search_.add(slot, S(1));
  std::vector<std::uint64_t> pairs = {7};
  this->search_.find(pairs);
  EXPECT_EQ(pairs, (std::vector<std::uint64_t>{7, 1, std::uint64_t{1} << 32 | 3}));
  EXPECT_TRUE(this->room_.step.report.clean());
}

TYPED_TEST(PairSearchTest, PairsBeyondTheMostArePassedOverAndReported) {
  using S = TypeParam;
  for (int i = 0; i < 5; ++i) this->room_.add(kNowhere);
  this->room_.state.settings.pairs = 6;
  this->room_.begin();
  for (std::uint32_t slot = 0; slot < 5; ++slot) this->search_.add(slot, S(1));
  std::vector<std::uint64_t> pairs;
  this->search_.find(pairs);
  EXPECT_EQ(pairs.size(), 6u);
  EXPECT_EQ(this->room_.step.report.lost_pairs, 1u);
}

}  // namespace
}  // namespace isostep
