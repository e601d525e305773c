// What writes leaves of an engine in the midst of a step, which the library itself only reads.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/state/leaves.hpp"
#include "isostep/world/world_kinds.hpp"

namespace isostep {

/// Is asked of every leaf which bits it shall have from now on. Leaves that may not be written keep theirs.
struct LeafEditor {
  std::uint64_t (*leaf)(void* user, const PathPart& path, LeafFormat format, std::uint64_t bits);
  void* user;
};

/// Edits the leaves of one part of an engine, in the order of LeafSource::walk.
using EditLeaves = void (*)(void* engine, LeafPart part, std::uint32_t stage, const LeafEditor& editor);

/// Of the engines behind the two kinds of world, compiled for the scalars that the library holds.
template <class S> void edit_rigid_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafEditor& editor);
template <class S>
void edit_particle_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafEditor& editor);

template <class S> constexpr EditLeaves edit_leaves_of(WorldTag<World<S>>) { return &edit_rigid_leaves<S>; }
template <class S> constexpr EditLeaves edit_leaves_of(WorldTag<ParticleWorld<S>>) { return &edit_particle_leaves<S>; }

}  // namespace isostep
