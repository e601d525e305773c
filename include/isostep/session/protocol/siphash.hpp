// SipHash-2-4: a keyed hash that who lacks the key can neither compute nor learn from other values of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "isostep/core/bytes.hpp"

namespace isostep {

struct SipKey {
  std::uint64_t low, high;  // bytes 0 to 7 and 8 to 15, little-endian
};

namespace detail {
struct SipState {
  std::uint64_t v0, v1, v2, v3;

  constexpr void round() {
    v0 += v1;
    v1 = std::rotl(v1, 13) ^ v0;
    v0 = std::rotl(v0, 32);
    v2 += v3;
    v3 = std::rotl(v3, 16) ^ v2;
    v0 += v3;
    v3 = std::rotl(v3, 21) ^ v0;
    v2 += v1;
    v1 = std::rotl(v1, 17) ^ v2;
    v2 = std::rotl(v2, 32);
  }
  constexpr void take(std::uint64_t word) {
    v3 ^= word;
    round();
    round();
    v0 ^= word;
  }
};
}  // namespace detail

/// Source: Aumasson, Bernstein 2012, SipHash: a fast short-input PRF, sec. 2.
constexpr std::uint64_t siphash_2_4(const SipKey& key, Bytes message) {
  detail::SipState state = {key.low ^ 0x736f6d6570736575u, key.high ^ 0x646f72616e646f6du,
                            key.low ^ 0x6c7967656e657261u, key.high ^ 0x7465646279746573u};
  const std::size_t whole = message.size() / 8 * 8;
  for (std::size_t at = 0; at < whole; at += 8) state.take(load_le<std::uint64_t>(message.data() + at));
  // The rest, and the length in the uppermost byte.
  std::uint64_t last = std::uint64_t{message.size()} << 56;
  for (std::size_t at = whole; at < message.size(); ++at) last |= std::uint64_t{message[at]} << (8 * (at - whole));
  state.take(last);
  state.v2 ^= 0xff;
  for (int i = 0; i < 4; ++i) state.round();
  return state.v0 ^ state.v1 ^ state.v2 ^ state.v3;
}

}  // namespace isostep
