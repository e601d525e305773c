// Editing the leaves of rigid worlds, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "diagnostics/leaf_editing.inl"
#include "isostep/world/engine_leaves.inl"

namespace isostep {

template <class S> void edit_rigid_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafEditor& editor) {
  const LeafEditing editing = {editor};
  static_cast<WorldEngine<S>*>(engine)->visit_leaves(part, stage, LeafVisitor(nullptr, editing));
}

#define ISO_INSTANTIATE(S) template void edit_rigid_leaves<S>(void*, LeafPart, std::uint32_t, const LeafEditor&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
