// The editor of the fields of rigid worlds, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "diagnostics/field_editing.inl"
#include "isostep/world/engine_fields.inl"

namespace isostep {

template <class S>
void edit_rigid_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldEditor& editor) {
  const FieldEditing editing = {editor};
  static_cast<WorldEngine<S>*>(engine)->visit_fields(group, stage, FieldVisitor(nullptr, editing));
}

#define ISO_INSTANTIATE(S) template void edit_rigid_fields<S>(void*, FieldGroup, std::uint32_t, const FieldEditor&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
