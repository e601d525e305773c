// Location: where the record of a body or joint lies.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// The array that holds a body or joint, and its index there; in StaticBodies it is a place.
struct Location {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kStatic = 0xfffffffeu;
  static constexpr std::uint32_t kAwake = 0xfffffffdu;
  std::uint32_t set = kNone;  // one of the above, or an index into WorldState::sleeping
  std::uint32_t index = 0;

  ISO_INLINE bool is_asleep() const { return set < kAwake; }
  ISO_FIELDS(set, index)
};

}  // namespace isostep
