// Numbers of a seed alone, for whatever the tests draw: the same on every machine.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/scalar/math.hpp"
#include "random/splitmix64.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

inline constexpr std::uint32_t kMaterialKinds = 3;  // that random worlds draw

/// Splitmix64. Two draws never stand among the arguments of one call, nor on both sides of an operator of a class:
/// compilers draw them in different orders.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() { return splitmix64(state_); }
  /// Dice of their own, which leave these as they are: what joins a world later does not change what was in it.
  Dice apart() const { return Dice(~state_); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>((next() >> 32) * n >> 32); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  /// Any of some, of which there is one at least.
  template <class T> const T& one_of(const std::vector<T>& all) {
    return all[below(static_cast<std::uint32_t>(all.size()))];
  }
  /// A number in whole thousandths.
  double in(double low, double high) { return low + (high - low) * below(1000) / 1000; }
  /// Every size as often as another: 0.01 to 0.1 as 0.1 to 1.
  double magnitude(double low, double high) { return low * isostep::exp(in(0, isostep::log(high / low))); }
  D3 point(double reach) {
    const double x = in(-reach, reach), y = in(-reach, reach), z = in(-reach, reach);
    return {x, y, z};
  }
  /// A vector of length 1; towards a cube's corners more often than towards its faces.
  D3 direction() {
    for (;;) {
      const D3 p = point(1);
      if (length(p) > 0.1) return p * (1 / length(p));
    }
  }
  /// Any way, low to high long. The length is drawn first.
  D3 arrow(double low, double high) { return arrow_of(in(low, high)); }
  D3 arrow_of(double length) { return direction() * length; }
  template <class S> Quat<Unit<S>> orientation() {
    using U = Unit<S>;
    const double x = in(-0.5, 0.5), y = in(-0.5, 0.5), z = in(-0.5, 0.5);
    return normalise(Quat<U>{num<U>(x), num<U>(y), num<U>(z), num<U>(0.75)});
  }

 private:
  std::uint64_t state_;
};

}  // namespace isostep::test
