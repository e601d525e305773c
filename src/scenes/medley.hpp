// Numbers that the scene `medley` and its script share.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::scenes::medley_body {

/// User data of bodies: their places in the order of creation, from 1.
inline constexpr std::uint64_t kHeap = 5;  // the first of eight
inline constexpr std::uint64_t kStackTop = 16;
inline constexpr std::uint64_t kGuest = 100;

}  // namespace isostep::scenes::medley_body
