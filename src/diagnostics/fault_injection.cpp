// FaultInjection: turns one bit.
// SPDX-License-Identifier: MIT
#include "diagnostics/fault_injection.hpp"

namespace isostep {

FaultInjection::FaultInjection(std::string_view path, std::uint32_t bit) : path_(path), bit_(bit) {}

bool FaultInjection::inject(const StageView& view, EditFields edit) const {
  struct Search {
    const FaultInjection& injection;
    bool found = false;
  } search{*this};
  const FieldEditor editor = {[](void* user, const PathPart& path, FieldFormat format, std::uint64_t bits) {
                                Search& s = *static_cast<Search*>(user);
                                if (s.injection.bit_ >= 8 * format.size || path_text(path) != s.injection.path_)
                                  return bits;
                                s.found = true;
                                return bits ^ std::uint64_t{1} << s.injection.bit_;
                              },
                              &search};
  for (const FieldGroup group : {FieldGroup::state, FieldGroup::scratch}) {
    edit(view.source_.engine, group, view.stage_, editor);
  }
  return search.found;
}

}  // namespace isostep
