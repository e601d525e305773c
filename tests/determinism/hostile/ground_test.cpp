// Hostile ground changes nothing: worker counts, lanes, roundings, traps, flushed denormals, shuffled addresses,
// rubbish in memory and on the stack, a library loaded with -ffast-math, commas for points. Each is shown to be there.
// SPDX-License-Identifier: MIT
#include "determinism/hostile/ground.hpp"

#include <dlfcn.h>

#include <clocale>
#include <csignal>
#include <locale>
#include <memory>
#include <set>
#include <thread>

#include "built.hpp"
#include "determinism/particle_mess.hpp"
#include "determinism/solver_scene.hpp"
#include "isostep/scalar/text.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::test {
namespace ground_test {

using Hashes = std::vector<std::uint64_t>;

/// Steps, and notes the hash of every frame. Numbers enter before the ground turns hostile: what a caller computes is
/// the caller's.
template <class W> void step_on(W& world, Holding& holding, Hashes& hashes) {
  std::uint64_t hash = 0;
  EXPECT_TRUE(holding([&] {
    world.step();
    hash = world.hash();
  })) << "the caller's environment came back changed";
  hashes.push_back(hash);
}

/// A crowd worth sharing, every solver's scene, and particles by both solvers and three integrators.
template <class S> Hashes hashes_on(const Ground& ground, int* calls = nullptr) {
  Holding holding(ground);
  Hashes hashes;
  {
    const scenes::Scene crowd = *scenes::find_scene("S7");
    World<S> w(scenes::settings_of<S>(crowd));
    scenes::build(crowd, w);
    w.use_simd(ground.simd);
    w.use_threads(holding.runner());
    for (int f = 0; f < 8; ++f) step_on(w, holding, hashes);
  }
  for (std::uint32_t i = 0; i < kSolvers; ++i) {
    if (left_out(SolverName{i}) != nullptr) continue;
    World<S> w(solver_settings<S>(static_cast<SolverName>(i)));
    w.use_simd(ground.simd);
    w.use_threads(holding.runner());
    const SolverScene<S> scene(w);
    for (std::uint64_t f = 0; f < 20; ++f) {
      w.apply_impulse(scene.bodies()[f % scene.bodies().size()], vec<S>(0.25, 0.125, -0.125));
      step_on(w, holding, hashes);
    }
  }
  for (const std::uint32_t way : {1u, 4u, 8u, 13u}) {
    ParticleWorld<S> w(settings_of_way<S>(way));
    w.use_simd(ground.simd);
    const ParticleMess mess = build_particle_mess(w);
    for (std::uint64_t f = 0; f < 12; ++f) {
      w.apply_impulse(mess.balls[f % mess.balls.size()], vec<S>(0.25, 0.5, -0.25));
      step_on(w, holding, hashes);
    }
  }
  EXPECT_TRUE(holding.workers_kept_their_state());
  if (calls != nullptr) *calls = holding.calls();
  return hashes;
}

template <class S> class HostileGround : public ::testing::Test {
 protected:
  static const Hashes& expected() {
    static const Hashes hashes = hashes_on<S>({});
    return hashes;
  }
};
TYPED_TEST_SUITE(HostileGround, AllScalars);

TYPED_TEST(HostileGround, is_crossed_by_scenes_in_which_every_frame_is_another) {
  const Hashes& hashes = this->expected();
  EXPECT_EQ(std::set<std::uint64_t>(hashes.begin(), hashes.end()).size(), hashes.size());
  EXPECT_EQ(hashes.size(), 8u + 20u * std::size(kBuiltSolvers) + 48u);
}

TYPED_TEST(HostileGround, of_all_kinds_at_once_changes_no_bit) {
  const Simd lanes[] = {Simd::scalar, Simd::sse2, Simd::avx2, Simd::avx512, Simd::best};
  const std::uint32_t controls[] = {kMasks | kDown,
                                    kMasks | kUp,
                                    kMasks | kTowardsZero,
                                    kMasks | kFlush,
                                    0u,
                                    kUp | kFlush | kDenormalsAreZero,
                                    kDown,
                                    kMasks | kTowardsZero | kDenormalsAreZero};
  for (int i = 0; i < 8; ++i) {
    const auto rubbish = static_cast<unsigned char>(i % 2 == 0 ? 0xa5 : 0x7f + 16 * i);
    const Ground ground = {i + 1, lanes[i % 5], controls[i], 1000u + static_cast<unsigned>(i), rubbish};
    int calls = 0;
    const std::uint64_t blocks = ShuffledHeap::blocks();
    const Hashes hashes = hashes_on<TypeParam>(ground, &calls);
    EXPECT_EQ(hashes, this->expected()) << i;
    EXPECT_GT(ShuffledHeap::blocks() - blocks, 1000u);
    EXPECT_GE(calls, i > 0 ? 8 : 0) << "threads were not asked";
  }
}

/// Slots of the heap, rubbish and all: what the tests above stand on.
TEST(TheShuffledHeap, is_in_effect) {
  const auto places = [](std::uint64_t seed, unsigned char rubbish) {
    const ShuffledHeap heap(seed, rubbish);
    std::vector<std::unique_ptr<unsigned char[]>> blocks;
    std::vector<std::ptrdiff_t> apart;
    for (int i = 0; i < 12; ++i) {
      blocks.emplace_back(new unsigned char[200]);
      EXPECT_EQ(blocks.back()[i], rubbish);
      apart.push_back(blocks.back().get() - blocks.front().get());
    }
    return apart;
  };
  const std::vector<std::ptrdiff_t> one = places(1, 0xa5), other = places(2, 0x5a);
  EXPECT_NE(one, other);
  EXPECT_FALSE(std::is_sorted(one.begin(), one.end()));
}

TEST(FloatEnvironments, are_in_effect) {
  const Hostile scope(kMasks);
  const std::vector<std::uint32_t> plain = own_arithmetic();
  for (const std::uint32_t control : {kDown, kUp, kTowardsZero, kFlush, kDenormalsAreZero}) {
    Hostile::set(kMasks | control);
    const std::vector<std::uint32_t> hostile = own_arithmetic();
    Hostile::set(kMasks);
    EXPECT_NE(hostile, plain) << control;
  }
  EXPECT_EXIT(
      {
        Hostile::set(0);
        own_arithmetic();
      },
      ::testing::KilledBySignal(SIGFPE), "");
}

/// gcc leaves rounding and precision of x87 to whoever sets them: nothing of ours is computed there.
TYPED_TEST(HostileGround, with_x87_cut_to_single_precision_changes_no_bit) {
  std::uint16_t before = 0, cut = 0x047f, after = 0;  // 24 bits, downwards
  __asm__ volatile("fnstcw %0" : "=m"(before));
  const auto third = [] {
    volatile long double one = 1, three = 3;
    return static_cast<double>(one / three);
  };
  const double plain = third();
  __asm__ volatile("fldcw %0" : : "m"(cut));
  const double hostile = third();
  const Hashes hashes = hashes_on<TypeParam>({});
  __asm__ volatile("fnstcw %0" : "=m"(after));
  __asm__ volatile("fldcw %0" : : "m"(before));
  EXPECT_NE(hostile, plain);
  EXPECT_EQ(hashes, this->expected());
  EXPECT_EQ(after, cut);
}

/// Its start-up code sets the state of the thread that loads it; threads that this one starts inherit it.
TYPED_TEST(HostileGround, of_a_library_linked_with_fast_math_changes_no_bit) {
  const Hostile scope(kMasks);
  ASSERT_FALSE(this->expected().empty());
  const std::vector<std::uint32_t> plain = own_arithmetic();
  void* const library = dlopen(ISOSTEP_FAST_MATH_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << dlerror();
  const std::uint32_t found = Hostile::control();
  if (own_arithmetic() == plain) {
    dlclose(library);
    GTEST_SKIP() << "this toolchain's -ffast-math sets no flags in who loads it";
  }
  EXPECT_EQ(found, kMasks | kFlush | kDenormalsAreZero);
  for (const int workers : {1, 4}) {
    const Ground ground = {workers, Simd::best, found};
    EXPECT_EQ(hashes_on<TypeParam>(ground), this->expected()) << workers;
    EXPECT_EQ(Hostile::control(), found) << "handed back as found";
  }
  std::uint32_t inherited = 0;
  std::thread([&] { inherited = Hostile::control(); }).join();
  EXPECT_EQ(inherited, found);
  dlclose(library);
}

TYPED_TEST(HostileGround, where_a_comma_is_the_decimal_point_changes_no_bit) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  ASSERT_FALSE(this->expected().empty());
  const std::string former = std::setlocale(LC_ALL, nullptr);
  const bool has_german = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  char half[8];
  std::snprintf(half, sizeof half, "%.1f", 0.5);
  const Hashes hashes = hashes_on<TypeParam>({});
  const std::string text = to_text(num<TypeParam>(1.5));
  TypeParam number = TypeParam(0);
  TextError error = {};
  const bool read = from_text("1.5", number, error);
  std::locale::global(before);
  std::setlocale(LC_ALL, former.c_str());
  EXPECT_EQ(hashes, this->expected());
  EXPECT_EQ(text, to_text(num<TypeParam>(1.5)));
  EXPECT_TRUE(read);
  EXPECT_EQ(number, num<TypeParam>(1.5));
  if (!has_german) GTEST_SKIP() << "no de_DE.UTF-8 here: only C++ streams had commas";
  EXPECT_STREQ(half, "0,5");
}

}  // namespace ground_test
}  // namespace isostep::test
