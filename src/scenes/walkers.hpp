// S18c: a crowd that walks over the pile of S4.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "scene.hpp"

namespace isostep::scenes {

inline constexpr int kWalkers = 200;
inline constexpr int kWalkersCome = 300;  // [frames] when the pile has settled
inline constexpr int kWalkersTurn = 60;   // [frames] between two directions
/// S4 for a longer time.
Scene walkers();
/// 200 characters, from frame 300 on, and their ways: every 60 frames a direction for each, drawn in order of their
/// slots.
template <class S> void lead_walkers(World<S>& world);

#define ISO_EXTERN(S) extern template void lead_walkers<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
