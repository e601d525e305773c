// The leaves of a state and of what one stage left, from this process or from lines of another's, and what differs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "isostep/state/leaves.hpp"

namespace isostep::tool {

class LeafList {
 public:
  void add(NamedLeaf leaf);
  const std::vector<NamedLeaf>& all() const { return leaves_; }
  const NamedLeaf* find(std::string_view path) const;
  std::optional<std::uint64_t> value(std::string_view path) const;

 private:
  std::vector<NamedLeaf> leaves_;
  std::unordered_map<std::string, std::size_t> places_;  // by path
};

/// Both as far as each has leaves of a path; answers the first path that one of them lacks, or nothing. Lists that
/// differ in length differ in a leaf "count", too.
std::optional<std::string> diff_leaves(const LeafList& a, const LeafList& b, DiffReport& report);

/// Whom a leaf belongs to: "body slot 17", "body slots 3 and 9", "particle slot 4"; empty where the path says it or
/// nobody is meant.
std::string owner_of(const LeafList& leaves, std::string_view path);

}  // namespace isostep::tool
