// Frame: the number of a game's frame.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// State f is the state from which frame f is stepped; state 0 is the start of the match.
using Frame = std::int32_t;
inline constexpr Frame kNoFrame = -1;
/// The largest frame; larger ones are refused everywhere. It is 200 days at 60 Hz, and sums of a few cannot overflow.
inline constexpr Frame kLastFrame = 1 << 30;

}  // namespace isostep
