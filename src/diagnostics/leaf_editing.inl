// The access by which a LeafVisitor edits. For files that instantiate an engine's walk: it has internal linkage.
// SPDX-License-Identifier: MIT
#pragma once

#include "diagnostics/leaf_editor.hpp"
#include "isostep/state/leaves.inl"

namespace isostep {
namespace {

struct LeafEditing {
  static constexpr bool kEdits = true;
  const LeafEditor& editor;

  std::uint64_t operator()(const PathPart& path, LeafFormat format, std::uint64_t bits) const {
    return editor.leaf(editor.user, path, format, bits);
  }
};

}  // namespace
}  // namespace isostep
