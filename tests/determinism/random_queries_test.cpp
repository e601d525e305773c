// Random worlds give every question one answer: saved and loaded, written and read, over lanes and threads.
// SPDX-License-Identifier: MIT
#include "built.hpp"
#include "examples/thread_pool.hpp"
#include "random/questions.hpp"
#include "random/world.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace random_queries_test {

template <class S> class RandomWorldAnswers : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kFrames = 90, kEvery = 9;
  const std::uint64_t kSeeds = sampled(18u, 6u);

  /// The world that was never interrupted is asked too: a question must not change what follows.
  struct Life {
    std::vector<std::uint64_t> hashes;  // of each frame
    std::vector<Answers<S>> answers;    // of each frame that is asked
  };
  static bool is_asked(std::uint64_t frame) { return frame % kEvery == kEvery - 1; }
  static Questions<S> questions(const World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    return draw_questions(w, seed * 15485863 + frame * 32452843 + 1);
  }
  static void step(World<S>& w, std::uint64_t seed, std::uint64_t frame) {
    RandomWorld<S>::command(w, seed, frame);
    w.step();
  }
  /// One lane, one thread, no interruption; and whether questions leave the state as it is.
  static Life expected(std::uint64_t seed) {
    RandomWorld<S> random(seed, SolverName::soft_step);
    random.world.use_simd(Simd::scalar);
    Life life;
    for (std::uint64_t f = 0; f < kFrames; ++f) {
      step(random.world, seed, f);
      life.hashes.push_back(random.world.hash());
      if (!is_asked(f)) continue;
      random.world.forget_faults();
      life.answers.emplace_back(random.world, questions(random.world, seed, f));
      EXPECT_EQ(random.world.hash(), life.hashes.back()) << "seed " << seed << " frame " << f;
    }
    return life;
  }
  /// Checks a world that stands where the expected one stood after the frame.
  static void check(World<S>& w, const Life& life, std::uint64_t seed, std::uint64_t frame, const char* which) {
    ASSERT_EQ(w.hash(), life.hashes[frame]) << which << ", seed " << seed << " frame " << frame;
    const Answers<S> answers(w, questions(w, seed, frame));
    ASSERT_EQ(answers.first_difference(life.answers[frame / kEvery]), -1)
        << which << ", seed " << seed << " frame " << frame;
  }
  static void expect_findings(const Found& found, std::size_t asked) {
    const std::size_t each = asked * QuestionsOf<S>::kOfEach;
    EXPECT_GT(found.rays, each / 3);
    EXPECT_GT(found.casts, each / 3);
    EXPECT_GT(found.overlaps, each / 8);
    EXPECT_GT(found.nearest, each / 3);
    EXPECT_GT(found.several, each / 8);
    EXPECT_GT(found.inside, each / 8);
    EXPECT_GT(found.triangles, each / 8);
    EXPECT_EQ(found.refused, 0u);
  }
  static void add(Found& sum, const Found& f) {
    sum.rays += f.rays, sum.casts += f.casts, sum.overlaps += f.overlaps, sum.nearest += f.nearest;
    sum.several += f.several, sum.inside += f.inside, sum.triangles += f.triangles, sum.refused += f.refused;
  }
};
TYPED_TEST_SUITE(RandomWorldAnswers, AllScalars);

TYPED_TEST(RandomWorldAnswers, are_those_of_a_world_that_is_loaded_read_or_over_other_lanes_threads_and_broad_phases) {
  using S = TypeParam;
  ThreadPool two(1), four(3);
  Found found;
  std::size_t asked = 0;
  for (std::uint64_t seed = 0; seed < this->kSeeds; ++seed) {
    const auto life = this->expected(seed);
    for (const Answers<S>& answers : life.answers) this->add(found, answers.found);
    asked += life.answers.size();
    RandomWorld<S> random(seed, SolverName::soft_step);
    World<S>& w = random.world;
    World<S> loader(w.settings()), reader_of(settings<S>(5, 10, 1));
    typename World<S>::Snapshot snapshot;
    for (std::uint64_t f = 0; f < this->kFrames; ++f) {
      w.use_simd(static_cast<Simd>(f % 7));
      w.use_threads(f % 2 == 0 ? two.runner() : four.runner());
      loader.use_broad_phase(kBuiltBroadPhases[(seed + f / this->kEvery) % std::size(kBuiltBroadPhases)]);
      this->step(w, seed, f);
      if (!this->is_asked(f)) continue;
      this->check(w, life, seed, f, "threads");
      w.save(snapshot);
      for (std::uint64_t k = f + 1; k < f + 4; ++k) this->step(w, seed, k);
      ASSERT_TRUE(w.load(snapshot));
      this->check(w, life, seed, f, "loaded");
      ASSERT_TRUE(loader.load(snapshot));
      this->check(loader, life, seed, f, "loaded elsewhere");
      const std::vector<std::uint8_t> bytes = bytes_of(w);
      Reader reader(bytes);
      ASSERT_TRUE(reader_of.read_portable(reader).ok());
      this->check(reader_of, life, seed, f, "read");
    }
  }
  this->expect_findings(found, asked);
}

}  // namespace random_queries_test
}  // namespace isostep::test
