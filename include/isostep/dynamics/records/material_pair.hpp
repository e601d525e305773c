// MaterialPair: what two kinds of material are to each other.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/id.hpp"
#include "isostep/dynamics/body.hpp"

namespace isostep {

using MaterialPairId = Id<struct MaterialPairTag>;

/// A row of the world's table of pairs. Where a surface of one kind meets one of the other, these numbers stand in
/// place of what the two materials mix to; their anisotropy and their belts count as before. The order of the kinds is
/// of no account: a second record of the same two is refused. A record with kinds of 0 is nothing.
template <class S> struct MaterialPair {
  std::uint32_t kind_a = 0, kind_b = 0;  // Material::kind, 1 or more
  S friction = S(0.6);                   // [1] of what slides
  S static_friction = S(0);              // [1] of what does not; below friction: the same
  S restitution = S(0);                  // [1] 0..1
  S rolling_resistance = S(0);           // [m]
  S spin_resistance = S(1.0 / 128);      // [m]

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("kind_a", self.kind_a);
    visit("kind_b", self.kind_b);
    visit("friction", self.friction);
    visit("static_friction", self.static_friction);
    visit("restitution", self.restitution);
    visit("rolling_resistance", self.rolling_resistance);
    visit("spin_resistance", self.spin_resistance);
  }
};

/// The same for (a, b) and (b, a).
ISO_INLINE constexpr std::uint64_t kinds_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

}  // namespace isostep
