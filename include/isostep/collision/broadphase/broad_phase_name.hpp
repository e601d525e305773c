// The coarse structures by name: the closed list that worlds and the tool speak of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "isostep/scalar/platform.hpp"

/// ISO_FOR_EACH_BROAD_PHASE(X) expands X(name, Structure): in BroadPhaseName and of the structure that it names.
#define ISO_FOR_EACH_BROAD_PHASE(X) \
  X(box_tree, AabbTree)             \
  X(sphere_tree, SphereTree)        \
  X(bsp_tree, BspTree)              \
  X(quad_tree, QuadTree) X(oct_tree, OctTree) X(grid, Grid) X(multi_grid, MultiGrid) X(sweep_and_prune, SweepAndPrune)

namespace isostep {

#define ISO_ENUMERATOR(name, Structure) name,
enum class BroadPhaseName : std::uint32_t { ISO_FOR_EACH_BROAD_PHASE(ISO_ENUMERATOR) };
#undef ISO_ENUMERATOR

#define ISO_NAME(name, Structure) #name,
inline constexpr const char* kBroadPhaseNames[] = {ISO_FOR_EACH_BROAD_PHASE(ISO_NAME)};
#undef ISO_NAME
inline constexpr std::uint32_t kBroadPhases = sizeof kBroadPhaseNames / sizeof kBroadPhaseNames[0];

ISO_INLINE std::optional<BroadPhaseName> broad_phase_named(std::string_view name) {
  for (std::uint32_t i = 0; i < kBroadPhases; ++i) {
    if (name == kBroadPhaseNames[i]) return static_cast<BroadPhaseName>(i);
  }
  return std::nullopt;
}

}  // namespace isostep
