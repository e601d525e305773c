// splitmix64: random words of a seed alone, for all that tests draw.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::test {

/// The next word. Every state has one, and any is a seed.
/// Source:  Steele, Lea, Flood 2014, Fast splittable pseudorandom number generators, OOPSLA.
inline std::uint64_t splitmix64(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace isostep::test
