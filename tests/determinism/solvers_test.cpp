// Every solver by name: exact rollback, the portable form, recordings, lanes and threads, in every scalar.
// SPDX-License-Identifier: MIT

#include <set>
#include <tuple>

#include "built.hpp"
#include "determinism/solver_cases.hpp"
#include "determinism/solver_scene.hpp"
#include "examples/thread_pool.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/state/verify.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {
namespace solvers_test {

constexpr std::uint64_t kFrames = 60;
using Hashes = std::vector<std::uint64_t>;

template <class S> Hashes hashes_of(SolverName solver, Simd simd, const TaskRunner& runner = {}) {
  World<S> w(solver_settings<S>(solver));
  w.use_simd(simd);
  w.use_threads(runner);
  const SolverScene<S> scene(w);
  Hashes hashes;
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    scene.play(w, f);
    hashes.push_back(w.hash());
  }
  return hashes;
}

template <class Case> class Solvers : public ::testing::Test {
 protected:
  using Number = std::tuple_element_t<0, Case>;
  static constexpr SolverName kSolver = std::tuple_element_t<1, Case>::value;
  static const Hashes& expected() {
    static const Hashes hashes = hashes_of<Number>(kSolver, Simd::scalar);
    return hashes;
  }
};

TYPED_TEST_SUITE(Solvers, SolverCases, SolverCaseNames);

TYPED_TEST(Solvers, are_given_something_to_do) {
  using S = typename TestFixture::Number;
  World<S> w(solver_settings<S>(this->kSolver));
  const SolverScene<S> scene(w);
  std::vector<D3> start;
  for (const BodyId id : scene.bodies()) start.push_back(real(w.center_of_mass(id)));
  const double before = scenes::measure_energy(w).total();
  std::size_t begins = 0, ends = 0, frames_alike = 0;
  std::set<std::uint64_t> seen;
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    scene.play(w, f);
    begins += w.events().contact_begin.size();
    ends += w.events().contact_end.size();
    frames_alike += seen.insert(w.hash()).second ? 0u : 1u;
  }
  EXPECT_EQ(frames_alike, 0u);
  EXPECT_GT(begins, 12u);
  EXPECT_GT(ends, 0u) << "something bounced";
  EXPECT_GT(w.counts().contacts, 9u);
  EXPECT_EQ(w.counts().joints, 6u);
  EXPECT_GT(std::fabs(scenes::measure_energy(w).total() - before), 1);
  EXPECT_LT(scenes::largest_joint_error(w), 0.1);
  double furthest = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    furthest = std::max(furthest, length(real(w.center_of_mass(scene.bodies()[i])) - start[i]));
  }
  EXPECT_GT(furthest, 0.5);
}

TYPED_TEST(Solvers, continue_from_a_snapshot_as_if_nothing_had_happened) {
  using S = typename TestFixture::Number;
  World<S> w(solver_settings<S>(this->kSolver)), other(solver_settings<S>(this->kSolver));
  const SolverScene<S> scene(w);
  typename World<S>::Snapshot snapshot;
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    if (f % 15 == 7) {
      w.save(snapshot);
      for (std::uint64_t k = f; k < f + 6; ++k) scene.play(w, k + 1000);  // another future
      w.load(snapshot);
      other.load(snapshot);
      for (std::uint64_t k = f; k < std::min(f + 6, kFrames); ++k) {
        scene.play(other, k);
        ASSERT_EQ(other.hash(), this->expected()[k]) << "frame " << k << " from " << f;
      }
    }
    scene.play(w, f);
    ASSERT_EQ(w.hash(), this->expected()[f]) << "frame " << f;
  }
}

TYPED_TEST(Solvers, continue_in_a_world_rebuilt_from_the_portable_form) {
  using S = typename TestFixture::Number;
  World<S> w(solver_settings<S>(this->kSolver)), rebuilt;
  const SolverScene<S> scene(w);
  for (std::uint64_t f = 0; f < 25; ++f) scene.play(w, f);
  const std::vector<std::uint8_t> bytes = bytes_of(w);
  Reader reader(bytes);
  ASSERT_TRUE(rebuilt.read_portable(reader).ok());
  EXPECT_EQ(rebuilt.settings().solver, this->kSolver);
  for (std::uint64_t f = 25; f < kFrames; ++f) {
    scene.play(rebuilt, f);
    ASSERT_EQ(rebuilt.hash(), this->expected()[f]) << "frame " << f;
  }
}

TYPED_TEST(Solvers, give_the_same_hashes_at_every_width_of_lanes_and_with_any_number_of_threads) {
  using S = typename TestFixture::Number;
  for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
    if (!World<S>().use_simd(simd)) continue;
    EXPECT_EQ(hashes_of<S>(this->kSolver, simd), this->expected()) << static_cast<unsigned>(simd);
  }
  for (const int threads : {2, 3}) {
    ThreadPool pool(threads);
    EXPECT_EQ(hashes_of<S>(this->kSolver, Simd::best, pool.runner()), this->expected()) << threads << " threads";
  }
}

TYPED_TEST(Solvers, are_recorded_and_verified) {
  using S = typename TestFixture::Number;
  World<S> w(solver_settings<S>(this->kSolver)), played;
  const SolverScene<S> scene(w);
  std::vector<std::uint8_t> file;
  {
    WorldRecorder<S> recorder(w, sink_to(file));
    ASSERT_TRUE(recorder.begin("solvers").ok());
    for (std::uint64_t f = 0; f < 30; ++f) {
      scene.play(w, f);
      ASSERT_TRUE(recorder.end_frame().ok());
    }
    ASSERT_TRUE(recorder.finish().ok());
  }
  const ReplayReader replay(file);
  EXPECT_EQ(replay.frame_count(), 30u);
  const auto accept = [](const ReplayHeader&) { return HeaderMismatch{}; };
  const VerifyResult result = verify_replay(replay, played, accept);
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(played.hash(), this->expected()[29]);
}

TYPED_TEST(Solvers, in_a_crowd_that_is_shared_out_give_the_hashes_of_one_thread) {
  using S = typename TestFixture::Number;
  const auto crowd = [&](const TaskRunner& runner) {
    World<S> w(solver_settings<S>(this->kSolver));
    w.use_threads(runner);
    add_ground(w);
    const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
    for (int i = 0; i < 90; ++i) w.create(moving<S>(box, {1.125 * (i % 6), 0.5 + i / 30, 1.125 * (i / 6 % 5)}));
    Hashes hashes;
    for (int f = 0; f < 6; ++f) {
      w.step();
      hashes.push_back(w.hash());
    }
    EXPECT_GT(w.counts().contacts, 80u);
    return hashes;
  };
  const Hashes alone = crowd({});
  for (const int threads : {2, 3}) {
    ThreadPool pool(threads);
    EXPECT_EQ(crowd(pool.runner()), alone) << threads << " threads";
  }
}

TEST(SolverNames, lead_to_different_futures) {
  std::set<std::uint64_t> ends;
  for (std::uint32_t i = 0; i < kSolvers; ++i) {
    if (left_out(SolverName{i}) != nullptr) continue;
    ends.insert(hashes_of<double>(static_cast<SolverName>(i), Simd::best).back());
  }
  EXPECT_EQ(ends.size(), std::size(kBuiltSolvers));
}

}  // namespace solvers_test
}  // namespace isostep::test
