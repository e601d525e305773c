// Random numbers that are the same on every machine: generators whose state is plain fields, and unbiased draws.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// x <- 1664525 x + 1013904223 mod 2^32: for scenes, whose published seeds mean this sequence. Its low bits are poor.
/// Source:  Numerical Recipes, 2nd ed., sec. 7.1, "an even quicker generator".
struct Lcg {
  std::uint32_t state;

  ISO_INLINE constexpr std::uint32_t next() { return state = 1664525u * state + 1013904223u; }
  /// The next state's upper 24 bits.
  ISO_INLINE constexpr std::uint32_t next_u24() { return next() >> 8; }
  friend ISO_INLINE constexpr bool operator==(const Lcg& a, const Lcg& b) { return a.state == b.state; }

  ISO_FIELDS(state)
};

/// PCG-XSH-RR with 64 bits of state and 32 of output: the generator for games. Period 2^64, 2^63 streams.
/// Source:  O'Neill 2014, PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms, sec. 6.3.1.
struct Pcg32 {
  std::uint64_t state;
  std::uint64_t increment;  // odd; names the stream

  static ISO_INLINE constexpr Pcg32 seeded(std::uint64_t seed, std::uint64_t stream = 0) {
    Pcg32 random{0, stream << 1 | 1u};
    random.next();
    random.state += seed;
    random.next();
    return random;
  }
  ISO_INLINE constexpr std::uint32_t next() {
    const std::uint64_t old = state;
    state = old * 6364136223846793005u + increment;
    const std::uint32_t mixed = static_cast<std::uint32_t>((old >> 18 ^ old) >> 27);
    const std::uint32_t turn = static_cast<std::uint32_t>(old >> 59);
    return mixed >> turn | mixed << ((32u - turn) & 31u);
  }
  ISO_INLINE constexpr std::uint32_t next_u24() { return next() >> 8; }
  friend ISO_INLINE constexpr bool operator==(const Pcg32& a, const Pcg32& b) {
    return a.state == b.state && a.increment == b.increment;
  }

  ISO_FIELDS(state, increment)
};

template <class R>
concept RandomSource = requires(R& random) {
  { random.next() } -> std::same_as<std::uint32_t>;
  { random.next_u24() } -> std::same_as<std::uint32_t>;
};

/// An integer in [0, bound), each equally likely; bound > 0. Draws again, rarely, where 2^32 does not divide evenly.
/// Source:  Lemire 2019, Fast Random Integer Generation in an Interval, ACM TOMACS 29(1), alg. 5.
template <RandomSource R> ISO_INLINE constexpr std::uint32_t random_below(R& random, std::uint32_t bound) {
  ISO_ASSERT(bound != 0);
  std::uint64_t scaled = std::uint64_t{random.next()} * bound;
  if (static_cast<std::uint32_t>(scaled) < bound) {
    const std::uint32_t rejected = (0u - bound) % bound;
    while (static_cast<std::uint32_t>(scaled) < rejected) scaled = std::uint64_t{random.next()} * bound;
  }
  return static_cast<std::uint32_t>(scaled >> 32);
}
/// An integer in [low, high], each equally likely; low <= high.
template <RandomSource R>
ISO_INLINE constexpr std::int32_t random_between(R& random, std::int32_t low, std::int32_t high) {
  const std::uint32_t span = static_cast<std::uint32_t>(high) - static_cast<std::uint32_t>(low) + 1u;  // 0 means 2^32
  const std::uint32_t offset = span == 0 ? random.next() : random_below(random, span);
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(low) + offset);
}

/// u24 / 2^24 in [0, 1), exact in every scalar: two digits of base 2^12, each below 1 by an exact division.
/// S needs 13 bits before the point.
template <class S> ISO_INLINE constexpr Step<S> unit_interval(std::uint32_t u24) {
  const Step<S> high = divide_to<Step<S>>(S(static_cast<std::int32_t>(u24 >> 12)), S(4096));
  const Step<S> low = divide_to<Step<S>>(S(static_cast<std::int32_t>(u24 & 4095u)), S(4096));
  return high + low * Step<S>(0x1p-12);
}

/// low + (high - low) u with u = u24 / 2^24: one draw, one rounding in fixed point. In [low, high], high itself only by
/// rounding. high - low must fit S.
template <class S, RandomSource R> ISO_INLINE constexpr S uniform(R& random, S low, S high) {
  const Step<S> u = unit_interval<S>(random.next_u24());
  return low + (high - low) * u;
}

}  // namespace isostep
