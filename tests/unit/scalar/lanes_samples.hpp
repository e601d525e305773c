// Numbers for lanes, in memory and out of it, and how two are compared: shared by the tests of every instruction set.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "isostep/scalar/lanes.hpp"

// Each test file keeps its own copy of all this, splitmix64 too, compiled for its own instruction set.
namespace {

using isostep::Fixed;
using isostep::Lanes;
using isostep::product;

struct Random {  // splitmix64
  std::uint64_t state;
  std::uint64_t next() {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
};

/// A number where things go wrong: ends, zeros, ties, denormals, infinities and NaN as often as ordinary values.
template <class S> S sample(Random& random) {
  using Raw = isostep::RawBits<S>;
  constexpr int kBits = static_cast<int>(sizeof(S)) * 8;
  const std::uint64_t bits = random.next();
  const int kind = random.below(4);
  if constexpr (isostep::kIsFixed<S>) {
    const Raw sign_bit = Raw{1} << (kBits - 1);
    const Raw ends[] = {0,
                        1,
                        static_cast<Raw>(-1),
                        sign_bit,
                        sign_bit + 1,
                        sign_bit - 1,
                        static_cast<Raw>(sign_bit / 2),
                        Raw{1} << (S::kFracBits - 1),
                        static_cast<Raw>(Raw{3} << (S::kFracBits - 1)),
                        static_cast<Raw>(0xffffffffu),
                        static_cast<Raw>(std::uint64_t{1} << 32)};
    if (kind == 0) return isostep::from_bits<S>(ends[random.below(11)]);
    if (kind == 1) return isostep::from_bits<S>(static_cast<Raw>(bits));
    if (kind == 2) return S::from_raw(static_cast<typename S::Raw>(bits) >> random.below(kBits));
    return isostep::from_bits<S>(static_cast<Raw>(static_cast<Raw>(bits) << random.below(kBits)));
  } else {
    using Limits = std::numeric_limits<S>;
    const S ends[] = {S(0),
                      S(1),
                      S(0.5),
                      Limits::denorm_min(),
                      Limits::min(),
                      Limits::max(),
                      Limits::infinity(),
                      Limits::quiet_NaN(),
                      Limits::epsilon(),
                      S(3)};
    const S sign = (bits >> 63) != 0 ? S(-1) : S(1);
    if (kind == 0) return sign * ends[random.below(10)];
    if (kind == 1) return isostep::from_bits<S>(static_cast<Raw>(bits));
    return sign * static_cast<S>(bits >> 40) / static_cast<S>(std::uint64_t{1} << random.below(48));
  }
}

template <class S> bool is_nan(S a) { return !(a == a); }
/// The very bits.
template <class S> bool same_bits(S a, S b) { return isostep::to_bits(a) == isostep::to_bits(b); }
/// The very bits, but one NaN is as good as another: which operand's NaN survives a sum is the compiler's choice.
template <class S> bool same_value(S a, S b) { return same_bits(a, b) || (is_nan(a) && is_nan(b)); }

/// W scalars in memory.
template <class L> struct Block {
  using S = typename L::Scalar;
  static constexpr int kWidth = L::kWidth;
  alignas(isostep::kLaneAlignment<S, kWidth>) S lane[kWidth];

  static Block sampled(Random& random) {
    Block r;
    for (S& a : r.lane) a = sample<S>(random);
    return r;
  }
  static Block of(L lanes) {
    Block r;
    lanes.store(r.lane);
    return r;
  }
  L load() const { return L::load(lane); }
};

#define EXPECT_LANES(same, lanes, scalar)                                                            \
  do {                                                                                               \
    const auto block = Block<std::remove_cvref_t<decltype(lanes)>>::of(lanes);                       \
    for (int i = 0; i < decltype(block)::kWidth; ++i) {                                              \
      ASSERT_TRUE(same(block.lane[i], (scalar))) << #lanes << ", lane " << i << ", round " << round; \
    }                                                                                                \
  } while (false)

constexpr int kRounds = 4000;

}  // namespace
