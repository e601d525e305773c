// Writers of an engine's fields in the midst of a step, which the library itself only reads.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/fields.hpp"

namespace isostep {

/// `field` is called for every field and returns the bits that it shall have from now on. Fields that may not be
/// written keep theirs.
struct FieldEditor {
  std::uint64_t (*field)(void* user, const PathPart& path, FieldFormat format, std::uint64_t bits);
  void* user;
};

/// Edits one group of the fields of an engine, in the order of FieldSource::walk.
using EditFields = void (*)(void* engine, FieldGroup group, std::uint32_t stage, const FieldEditor& editor);

/// Edits the fields of the engines behind the two kinds of world, compiled for the scalars that the library holds.
template <class S>
void edit_rigid_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldEditor& editor);
template <class S>
void edit_particle_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldEditor& editor);

template <class S> constexpr EditFields edit_fields_of(WorldTag<World<S>>) { return &edit_rigid_fields<S>; }
template <class S> constexpr EditFields edit_fields_of(WorldTag<ParticleWorld<S>>) { return &edit_particle_fields<S>; }

}  // namespace isostep
