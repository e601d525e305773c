// Random worlds of everything at once have one future: saved and loaded, written and read, over lanes and threads.
// SPDX-License-Identifier: MIT

#include "determinism/solver_cases.hpp"
#include "examples/thread_pool.hpp"
#include "random/world.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace random_worlds_test {

template <class Case> class RandomWorldFutures : public ::testing::Test {
 protected:
  using Scalar = std::tuple_element_t<0, Case>;
  static constexpr SolverName kSolver = std::tuple_element_t<1, Case>::value;
  static constexpr std::uint64_t kFrames = 90;
  const std::uint64_t kSeeds = solves_islands(kSolver) ? sampled(3u, 1u) : sampled(8u, 3u);

  static std::uint64_t play(World<Scalar>& w, std::uint64_t seed, std::uint64_t frame) {
    RandomWorld<Scalar>::command(w, seed, frame);
    w.step();
    return w.hash();
  }
  /// One lane, one thread, no interruption.
  static std::vector<std::uint64_t> expected(std::uint64_t seed) {
    RandomWorld<Scalar> random(seed, kSolver);
    random.world.use_simd(Simd::scalar);
    std::vector<std::uint64_t> hashes;
    for (std::uint64_t f = 0; f < kFrames; ++f) hashes.push_back(play(random.world, seed, f));
    return hashes;
  }
};
TYPED_TEST_SUITE(RandomWorldFutures, SolverCases, SolverCaseNames);

TYPED_TEST(RandomWorldFutures, of_a_world_that_is_loaded_or_read_is_that_of_one_that_never_was) {
  using S = std::tuple_element_t<0, TypeParam>;
  for (std::uint64_t seed = 0; seed < this->kSeeds; ++seed) {
    const std::vector<std::uint64_t> expected = this->expected(seed);
    RandomWorld<S> random(seed, this->kSolver);
    World<S>& w = random.world;
    World<S> reader_of(settings<S>(5, 10, 1));
    typename World<S>::Snapshot snapshot;
    for (std::uint64_t f = 0; f < this->kFrames; ++f) {
      if (f % 7 == 3) {
        w.save(snapshot);
        for (std::uint64_t k = f; k < std::min(f + 3, this->kFrames); ++k) {
          ASSERT_EQ(this->play(w, seed, k), expected[k]) << "seed " << seed << " frame " << k << " before";
        }
        w.load(snapshot);
      }
      if (f % 31 == 30) {
        const std::vector<std::uint8_t> bytes = bytes_of(w);
        Reader reader(bytes);
        ASSERT_TRUE(reader_of.read_portable(reader).ok());
        for (std::uint64_t k = f; k < std::min(f + 10, this->kFrames); ++k) {
          ASSERT_EQ(this->play(reader_of, seed, k), expected[k]) << "seed " << seed << " frame " << k << " read";
        }
      }
      ASSERT_EQ(this->play(w, seed, f), expected[f]) << "seed " << seed << " frame " << f;
    }
  }
}

TYPED_TEST(RandomWorldFutures, is_one_over_all_lanes_and_threads) {
  using S = std::tuple_element_t<0, TypeParam>;
  ThreadPool pool(3);
  for (std::uint64_t seed = 0; seed < this->kSeeds; ++seed) {
    const std::vector<std::uint64_t> expected = this->expected(seed);
    RandomWorld<S> random(seed, this->kSolver);
    random.world.use_threads(pool.runner());
    for (std::uint64_t f = 0; f < this->kFrames; ++f) {
      random.world.use_simd(static_cast<Simd>(f % 7));
      ASSERT_EQ(this->play(random.world, seed, f), expected[f]) << random.world.simd_name() << " frame " << f;
    }
  }
}

}  // namespace random_worlds_test
}  // namespace isostep::test
