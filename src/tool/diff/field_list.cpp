// Fields side by side.
// SPDX-License-Identifier: MIT
#include "field_list.hpp"

namespace isostep::tool {

void FieldList::add(NamedField field) {
  places_.emplace(field.path, fields_.size());
  fields_.push_back(std::move(field));
}
const NamedField* FieldList::find(std::string_view path) const {
  const auto found = places_.find(std::string(path));
  return found == places_.end() ? nullptr : &fields_[found->second];
}
std::optional<std::uint64_t> FieldList::value(std::string_view path) const {
  const NamedField* const field = find(path);
  return field == nullptr ? std::nullopt : std::optional(field->bits);
}

std::optional<std::string> diff_fields(const FieldList& a, const FieldList& b, DiffReport& report) {
  std::optional<std::string> missing;
  for (const NamedField& field : a.all()) {
    const NamedField* const other = b.find(field.path);
    if (other == nullptr) {
      if (!missing) missing = field.path;
    } else if (other->bits != field.bits) {
      report.add(PathPart{nullptr, field.path.c_str(), 0}, field.format, field.bits, other->bits);
    }
  }
  for (const NamedField& field : b.all()) {
    if (!missing && a.find(field.path) == nullptr) missing = field.path;
  }
  return missing;
}

}  // namespace isostep::tool
