// Generation ids: a slot that is reused and a generation that is not.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/field_names.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Names one thing of a world. A default id names nothing; a stale one is refused wherever it is used, and so is one of
/// a world with another Settings::id_space. Two worlds with the same space cannot tell their ids apart.
template <class Tag> struct Id {
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;  // 0: null

  ISO_INLINE constexpr explicit operator bool() const { return generation != 0; }
  friend ISO_INLINE constexpr bool operator==(Id a, Id b) { return a.slot == b.slot && a.generation == b.generation; }
  friend ISO_INLINE constexpr bool operator!=(Id a, Id b) { return !(a == b); }

  ISO_FIELDS(slot, generation)
};

using BodyId = Id<struct BodyTag>;
using ShapeId = Id<struct ShapeTag>;
using JointId = Id<struct JointTag>;

}  // namespace isostep
