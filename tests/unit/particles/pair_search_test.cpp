// The search for pairs: how far particles may come in a step, and what happens beyond the most pairs.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/pair_search.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace pair_search_test {

template <class S> class PairSearchTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  PairSearch<S> search_{scene_.state, scene_.step};
};
TYPED_TEST_SUITE(PairSearchTest, Scalars);

TYPED_TEST(PairSearchTest, ReachIsTwiceTheWayOfAStep) {
  using S = TypeParam;
  const ParticleId fast = this->scene_.add(kNowhere, {0, -30, 0}), slow = this->scene_.add(kRight);
  this->scene_.begin();
  this->search_.begin_step();
  EXPECT_NEAR(to_double(this->search_.reach_of(fast.slot)), 1, 256 * grain<S>(1));
  EXPECT_NEAR(to_double(this->search_.reach_of(slow.slot)), 2.0 / 60, 256 * grain<S>(1));  // of 1 m/s
}

TYPED_TEST(PairSearchTest, SpringsReachAsFarAsTheyMayPullInAStep) {
  using S = TypeParam;
  const ParticleId a = this->scene_.add(kNowhere), b = this->scene_.add({3, 0, 0});
  this->scene_.state.springs.add(this->scene_.spring(a, b, 900, 1));
  this->scene_.begin();
  this->search_.begin_step();
  EXPECT_NEAR(to_double(this->search_.reach_of(a.slot)), 2.0 / 60, 256 * grain<S>(1)) << "nothing that it may meet";
  this->scene_.make_balls(0.5);
  this->search_.begin_step();
  EXPECT_NEAR(to_double(this->search_.reach_of(a.slot)), 2.0 / 60 + 2 * 900.0 / 3600, 256 * grain<S>(1));
}

TYPED_TEST(PairSearchTest, FindsPairsInReachAscendingAndOnlyWhatWasAdded) {
  using S = TypeParam;
  for (int i = 0; i < 4; ++i) this->scene_.add({static_cast<double>(i), 0, 0});
  this->scene_.begin();
  this->search_.begin_step();
  this->search_.clear();
  for (const std::uint32_t slot : {0u, 1u, 3u}) this->search_.add(slot, S(1));
  std::vector<std::uint64_t> pairs = {7};
  this->search_.find(pairs);
  EXPECT_EQ(pairs, (std::vector<std::uint64_t>{7, 1, std::uint64_t{1} << 32 | 3}));
  EXPECT_TRUE(this->scene_.step.report.clean());
}

TYPED_TEST(PairSearchTest, PairsBeyondTheMostArePassedOverAndReported) {
  using S = TypeParam;
  for (int i = 0; i < 5; ++i) this->scene_.add(kNowhere);
  this->scene_.state.settings.pairs = 6;
  this->scene_.begin();
  for (std::uint32_t slot = 0; slot < 5; ++slot) this->search_.add(slot, S(1));
  std::vector<std::uint64_t> pairs;
  this->search_.find(pairs);
  EXPECT_EQ(pairs.size(), 6u);
  EXPECT_EQ(this->scene_.step.report.lost_pairs, 1u);
}

}  // namespace pair_search_test
}  // namespace isostep
