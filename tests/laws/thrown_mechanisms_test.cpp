// Random mechanisms thrown at walls at 20 to 100 m/s: nothing gets through, joints hold, nothing gains energy.
// ISOSTEP_THROWN asks for other than kSeeds of them.
// SPDX-License-Identifier: MIT

#include "laws/thrown_mechanisms.hpp"

#include "random/asked.hpp"

namespace isostep::test {
namespace {

template <class S> class ThrownMechanisms : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeeds = 24;  // three of each kind
};
/// Not Q16.16: what they weigh and how fast they turn is beyond its ratios.
using WideScalars = ::testing::Types<float, double, Q32_32>;
TYPED_TEST_SUITE(ThrownMechanisms, WideScalars);

TYPED_TEST(ThrownMechanisms, stay_in_their_room_and_in_one_piece) {
  using S = TypeParam;
  for (std::uint64_t seed = 0; seed < asked("ISOSTEP_THROWN", this->kSeeds); ++seed) {
    const ThrownFindings found = throw_mechanism<S>(seed, SolverName::soft_step);
    EXPECT_EQ(found.outside, 0) << seed;
    EXPECT_EQ(found.faults, 0) << seed;
    EXPECT_LT(found.apart, 0.1) << seed;
    EXPECT_LT(found.later, 0.005) << seed;
    EXPECT_LT(found.gained, 0.001) << seed;
    EXPECT_LT(found.slowest, 0.5) << seed << ": hit nothing";
  }
}

}  // namespace
}  // namespace isostep::test
