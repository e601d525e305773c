// Leaves side by side.
// SPDX-License-Identifier: MIT
#include "leaf_list.hpp"

namespace isostep::tool {

void LeafList::add(NamedLeaf leaf) {
  places_.emplace(leaf.path, leaves_.size());
  leaves_.push_back(std::move(leaf));
}
const NamedLeaf* LeafList::find(std::string_view path) const {
  const auto found = places_.find(std::string(path));
  return found == places_.end() ? nullptr : &leaves_[found->second];
}
std::optional<std::uint64_t> LeafList::value(std::string_view path) const {
  const NamedLeaf* const leaf = find(path);
  return leaf == nullptr ? std::nullopt : std::optional(leaf->bits);
}

std::optional<std::string> diff_leaves(const LeafList& a, const LeafList& b, DiffReport& report) {
  std::optional<std::string> missing;
  for (const NamedLeaf& leaf : a.all()) {
    const NamedLeaf* const other = b.find(leaf.path);
    if (other == nullptr) {
      if (!missing) missing = leaf.path;
    } else if (other->bits != leaf.bits) {
      report.add(PathPart{nullptr, leaf.path.c_str(), 0}, leaf.format, leaf.bits, other->bits);
    }
  }
  for (const NamedLeaf& leaf : b.all()) {
    if (!missing && a.find(leaf.path) == nullptr) missing = leaf.path;
  }
  return missing;
}

}  // namespace isostep::tool
