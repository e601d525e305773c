// pin_floats against callers that left the floating-point unit in every wrong state, and the probe that tells.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/environment.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace isostep {
namespace environment_test {

using State = detail::FloatState;

// Out of line, so that the compiler cannot move their arithmetic across a change of state.
__attribute__((noinline)) std::uint32_t probe_here() { return probe_environment_here(); }
__attribute__((noinline)) std::uint64_t sums() {
  volatile float one = 1, bit = 0x1p-25f, small = 0x1p-126f, half = 0.5f, three = 3;
  volatile double third = 1 / double(three);
  volatile std::int64_t odd = (std::int64_t(1) << 40) + 1;  // 24 bits do not hold it; i686 converts in another unit
  const float up = one + bit, down = -one - bit, flushed = small * half, converted = static_cast<float>(odd);
  std::uint64_t hash = std::bit_cast<std::uint64_t>(double(third));
  for (const float x : {up, down, flushed, converted}) {
    hash = hash * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(x);
  }
  return hash;
}

/// The states a caller may have: the control bits of one kind each, and all together.
std::vector<std::uint64_t> hostile_states(std::uint64_t sound) {
#if defined(__SSE2__)
  return {
#if defined(__i386__)
    sound | 0x0800'0000'0000,                                                          // x87: up
        sound & ~std::uint64_t{0x0100'0000'0000},                                      // x87: sums of 53 bits
        sound | 0x0020'0000'0000'0000, sound & ~std::uint64_t{0x007f'0000'0000'0000},  // x87: flags
#endif
        sound | 0x8000, sound | 0x0040, sound | 0x8040, sound | 0x2000, sound | 0x4000, sound | 0x6000, sound | 0xe040,
        sound | 0x3f, sound & ~std::uint64_t{0x3f}, (sound & ~std::uint64_t{0x3f}) | 0xe040 | 0x1
  };
#elif defined(__aarch64__) || (defined(__arm__) && defined(__ARM_FP))
  return {sound | 1u << 24, sound | 1u << 22, sound | 2u << 22, sound | 3u << 22, sound | 7u << 22};
#elif defined(__riscv_flen)
  return {sound | 1u << 5, sound | 2u << 5, sound | 3u << 5, sound | 0x1f, sound & ~std::uint64_t{0x1f}};
#elif defined(__s390x__)
  return {sound | 1, sound | 2, sound | 3};
#elif defined(__powerpc__)
  return {sound | 1, sound | 2, sound | 3, sound | 0x06000000, sound & ~std::uint64_t{0x06000000}};
#else
  static_cast<void>(sound);
  return {};
#endif
}

class PinFloatsTest : public testing::Test {
 protected:
  void TearDown() override { State::write(before_); }
  std::uint64_t before_ = State::read();
};

TEST_F(PinFloatsTest, APinnedCallComputesRightWhateverTheCallerSet) {
  const std::uint64_t expected = sums();
  for (const std::uint64_t state : hostile_states(before_)) {
    State::write(state);
    std::uint64_t inside = 0;
    std::uint32_t here = 1, library = 1;
    pin_floats([&] {
      inside = sums();
      here = probe_here();
      library = probe_environment();
    });
    State::write(before_);
    EXPECT_EQ(inside, expected) << std::hex << state;
    EXPECT_EQ(here, 0u) << std::hex << state;
    EXPECT_EQ(library, 0u) << std::hex << state;
  }
}

template <class S> struct Triple { S x, y, z; };

/// As the library's functions are written: numbers of the arguments, a number returned, all in one function.
template <class S> __attribute__((noinline)) S quotient(S a, S b) {
  return pin_floats([&] { return a / b; });
}
template <class S> __attribute__((noinline)) Triple<S> midway(Triple<S> a, Triple<S> b, S share) {
  return pin_floats([&]() -> Triple<S> {
    if (share == S(0)) return a;
    return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share};
  });
}

/// A compiler knows nothing of the state, and clang moved a last division behind the caller's return.
TEST_F(PinFloatsTest, NoArithmeticOfAFunctionLiesOutside) {
  const auto all = [](auto tag) {
    using S = decltype(tag);
    const Triple<S> between = midway<S>({S(0.1), S(0.7), S(-0.3)}, {S(1.3), S(0x1p-100), S(7)}, S(0.3));
    return std::array{quotient(S(1), S(3)),
                      quotient(S(-1), S(3)),
                      quotient(std::numeric_limits<S>::min(), S(3)),
                      between.x,
                      between.y,
                      between.z};
  };
  const auto floats = all(float{});
  const auto doubles = all(double{});
  for (const std::uint64_t state : hostile_states(before_)) {
    State::write(state);
    const auto floats_now = all(float{});
    const auto doubles_now = all(double{});
    State::write(before_);
    EXPECT_EQ(floats_now, floats) << std::hex << state;
    EXPECT_EQ(doubles_now, doubles) << std::hex << state;
  }
}

TEST_F(PinFloatsTest, TheCallersStateReturnsBitForBit) {
  for (const std::uint64_t state : hostile_states(before_)) {
    State::write(state);
    const std::uint64_t set = State::read();
    pin_floats([&] {
      sums();  // raises the inexact and underflow flags
    });
    const std::uint64_t left = State::read();
    State::write(before_);
    EXPECT_EQ(left, set) << std::hex << state;
    EXPECT_EQ(set, state) << "the processor refused a state, so the test shows nothing";
  }
}

TEST_F(PinFloatsTest, CallsNest) {
  for (const std::uint64_t state : hostile_states(before_)) {
    State::write(state);
    std::uint64_t between = 0;
    pin_floats([&] {
      pin_floats([] {});
      between = State::read();
    });
    const std::uint64_t left = State::read();
    State::write(before_);
    EXPECT_EQ(State::pinned(between), between) << "the inner call must leave the outer's state";
    EXPECT_EQ(left, state);
  }
}

TEST_F(PinFloatsTest, ASoundStateIsNotWritten) {
  const std::uint64_t sound = State::pinned(before_);
  EXPECT_EQ(State::pinned(sound), sound);
  State::write(sound);
  EXPECT_EQ(probe_here(), 0u);
}

TEST_F(PinFloatsTest, EveryHostileStateIsTold) {
  for (const std::uint64_t state : hostile_states(before_)) {
    if (State::pinned(state) == state) continue;  // only sticky flags differ
    State::write(state);
    const std::uint32_t here = probe_here();
    const std::uint32_t library = probe_environment();
    State::write(before_);
    EXPECT_NE(here, 0u) << std::hex << state;
    EXPECT_EQ(here, library) << std::hex << state;
  }
}

#if defined(__SSE2__)
TEST_F(PinFloatsTest, TheProbeNamesTheCause) {
  const auto probe_under = [&](std::uint64_t bits) {
    State::write(before_ | bits);
    const std::uint32_t found = probe_here();
    State::write(before_);
    return found;
  };
  EXPECT_EQ(probe_under(0), 0u);
  EXPECT_EQ(probe_under(0x8000), bit_of(Deviation::flush_float) | bit_of(Deviation::flush_double));
  EXPECT_EQ(probe_under(0x0040), bit_of(Deviation::zero_float) | bit_of(Deviation::zero_double));
  for (const std::uint64_t mode : {0x2000u, 0x4000u, 0x6000u}) {
    EXPECT_NE(probe_under(mode) & bit_of(Deviation::rounding), 0u) << mode;
  }
}

TEST_F(PinFloatsTest, TheProbeNeitherTrapsNorLeavesFlags) {
  const std::uint64_t trapping = before_ & ~std::uint64_t{0x1fbf};  // every mask and every flag
  State::write(trapping);
  const std::uint32_t here = probe_here(), library = probe_environment();
  const std::uint64_t left = State::read();
  State::write(before_);
  EXPECT_EQ(here | library, 0u);
  EXPECT_EQ(left, trapping);
}

TEST_F(PinFloatsTest, ExceptionsAreMaskedInside) {
  State::write(before_ & ~std::uint64_t{0x0200});  // a division by zero would now end the program
  pin_floats([&] {
    volatile float one = 1, zero = 0;
    volatile float infinite = one / zero;
    static_cast<void>(infinite);
  });
  State::write(before_);
  SUCCEED();
}
#endif

#if defined(__i386__)
/// The x87 traps at the instruction after: a flag that a guarded conversion left would end a caller who has no mask.
TEST_F(PinFloatsTest, ConversionsInsideDoNotTrapOutside) {
  constexpr std::uint64_t kInexactMask = 0x0020'0000'0000, kInexactFlag = 0x0020'0000'0000'0000;
  const std::uint64_t unmasked = before_ & ~(kInexactMask | kInexactFlag);
  State::write(unmasked);
  std::uint64_t inside = 0;
  pin_floats([&] {
    sums();
    inside = State::read();
  });
  __asm__ volatile("fwait");
  const std::uint64_t left = State::read();
  State::write(before_);
  EXPECT_NE(inside & kInexactFlag, 0u) << "the x87 rounded nothing, so the test shows nothing";
  EXPECT_EQ(left, unmasked);
}
#endif

TEST(Deviations, HaveDistinctNames) {
  for (int i = 0; i < kDeviationCount; ++i) {
    ASSERT_NE(kDeviationNames[i], nullptr);
    for (int k = 0; k < i; ++k) EXPECT_STRNE(kDeviationNames[i], kDeviationNames[k]);
  }
  EXPECT_EQ(bit_of(Deviation::zero_sign), 1u << (kDeviationCount - 1));
}

}  // namespace environment_test
}  // namespace isostep
