// The coarse structures by name: the closed list that worlds and the tool speak of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "isostep/core/book.hpp"
#include "isostep/scalar/platform.hpp"

/// ISO_FOR_EACH_BROAD_PHASE(X) expands X(name, Structure): the name in BroadPhaseName and the structure that it names;
/// ISO_FOR_EACH_BUILT_BROAD_PHASE(X) does so for those that this build holds.
// clang-format off
#define ISO_BROAD_PHASES(X, BOOK)                                 \
  X(box_tree, AabbTree) BOOK(sphere_tree, SphereTree)             \
  BOOK(bsp_tree, BspTree) BOOK(quad_tree, QuadTree)               \
  BOOK(oct_tree, OctTree) BOOK(grid, Grid)                        \
  BOOK(multi_grid, MultiGrid) BOOK(sweep_and_prune, SweepAndPrune)
// clang-format on
#define ISO_FOR_EACH_BROAD_PHASE(X) ISO_BROAD_PHASES(X, X)
#define ISO_FOR_EACH_BUILT_BROAD_PHASE(X) ISO_BROAD_PHASES(X, ISO_BUILT_BOOK(X))

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

/// Returns what a fault expects instead of a structure that this build leaves out (core/book.hpp). Null for a structure
/// that the build holds, and for a number that names none.
ISO_INLINE constexpr const char* expected_instead_of(BroadPhaseName name) {
  constexpr const char* kExpected[] = {ISO_BROAD_PHASES(ISO_NOT_LEFT_OUT, ISO_LEFT_OUT)};
  const auto index = static_cast<std::uint32_t>(name);
  return index < kBroadPhases ? kExpected[index] : nullptr;
}

}  // namespace isostep
