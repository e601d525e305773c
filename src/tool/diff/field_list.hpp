// The fields of a state and of what one stage left, from this process or from lines of another's, and what differs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "isostep/state/fields.hpp"

namespace isostep::tool {

class FieldList {
 public:
  void add(NamedField field);
  const std::vector<NamedField>& all() const { return fields_; }
  const NamedField* find(std::string_view path) const;
  std::optional<std::uint64_t> value(std::string_view path) const;

 private:
  std::vector<NamedField> fields_;
  std::unordered_map<std::string, std::size_t> places_;  // by path
};

/// Both as far as each has fields of a path; returns the first path that one of them lacks, or nothing. Lists that
/// differ in length differ in a field "count", too.
std::optional<std::string> diff_fields(const FieldList& a, const FieldList& b, DiffReport& report);

/// The owner of a field: "body slot 17", "body slots 3 and 9", "particle slot 4"; empty where the path says it or
/// nobody is meant.
std::string owner_of(const FieldList& fields, std::string_view path);

}  // namespace isostep::tool
