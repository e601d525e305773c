// The access by which a FieldVisitor edits. For files that instantiate an engine's walk: it has internal linkage.
// SPDX-License-Identifier: MIT
#pragma once

#include "diagnostics/field_editor.hpp"
#include "isostep/state/fields.inl"

namespace isostep {
namespace {

struct FieldEditing {
  static constexpr bool kEdits = true;
  const FieldEditor& editor;

  std::uint64_t operator()(const PathPart& path, FieldFormat format, std::uint64_t bits) const {
    return editor.field(editor.user, path, format, bits);
  }
};

}  // namespace
}  // namespace isostep
