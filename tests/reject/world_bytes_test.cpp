// Damaged portable forms of random worlds: refused with a reason and without a change, or read as what they say. A
// state has one form, so what is read is written as it was read.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "random/world.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace world_bytes_test {

template <class S> class WorldBytes : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kRecords = 1200;  // [bytes] at the end, about those of records and their states
  int accepted = 0, refused = 0;

  static std::vector<std::uint8_t> form_of(std::uint64_t seed) {
    RandomWorld<S> random(seed, SolverName::soft_step);
    for (std::uint64_t frame = 0; frame < 20; ++frame) random.play(frame);
    return bytes_of(random.world);
  }
  void read(const std::vector<std::uint8_t>& bytes, World<S>& w, std::size_t at) {
    const std::uint64_t before = w.hash();
    Reader reader(bytes);
    const Result<void> result = w.read_portable(reader);
    if (!result.ok()) {
      ++refused;
      EXPECT_FALSE(result.error().message.view().empty());
      EXPECT_EQ(w.hash(), before) << "a refused form changed the world";
      return;
    }
    ++accepted;
    EXPECT_TRUE(reader.remaining() > 0 || bytes_of(w) == bytes)
        << "byte " << at << " of " << bytes.size() << ", " << +bytes[at];
  }
};
TYPED_TEST_SUITE(WorldBytes, AllScalars);

TYPED_TEST(WorldBytes, a_state_has_one_form) {
  using S = TypeParam;
  const std::uint64_t seeds = sampled(200u, 12u);
  for (std::uint64_t seed = 0; seed < seeds && !this->HasFailure(); ++seed) {
    std::vector<std::uint8_t> bytes = this->form_of(seed);
    Dice dice(seed * 104729 + 3);
    World<S> w(settings<S>());
    const auto size = static_cast<std::uint32_t>(bytes.size());
    for (int i = 0; i < 3000; ++i) {
      const std::uint32_t tail = std::min(size, TestFixture::kRecords);
      const std::size_t at = i % 2 == 0 ? dice.below(size) : size - 1 - dice.below(tail);
      const auto bit = static_cast<std::uint8_t>(1u << dice.below(8));
      bytes[at] ^= bit;
      this->read(bytes, w, at);
      bytes[at] ^= bit;
    }
  }
  EXPECT_GT(this->accepted, 100);
  EXPECT_GT(this->refused, 100);
}

}  // namespace world_bytes_test
}  // namespace isostep::test
