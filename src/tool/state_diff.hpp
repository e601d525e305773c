// All differences of two world states, by name.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/state/diff.hpp"
#include "isostep/world/state.hpp"

namespace isostep::tool {

namespace detail {
/// Vectors, or arrays in pages.
template <class Array> void diff_array(const PathPart& path, const Array& a, const Array& b, DiffReport& report) {
  if (a.size() != b.size()) report.add(PathPart{&path, "count", 0}, kLeafFormat<std::uint64_t>, a.size(), b.size());
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    diff_value(PathPart{&path, nullptr, i}, a[i], b[i], report);
}
inline void diff_slots(const char* name, const SlotMap& a, const SlotMap& b, DiffReport& report) {
  const PathPart path{nullptr, name, 0};
  diff_value(PathPart{&path, "first_free", 0}, a.first_free(), b.first_free(), report);
  diff_array(path, a.entries(), b.entries(), report);
}
/// Walks two objects' sections side by side.
template <class Object>
void diff_sections(const PathPart* outer, const Object& a, const Object& b, DiffReport& report) {
  std::size_t index = 0;
  Object::sections(
      [&](const char* name, const auto& of_a) {
        std::size_t other = 0;
        Object::sections(
            [&](const char*, const auto& of_b) {
              if constexpr (std::is_same_v<decltype(of_a), decltype(of_b)>) {
                if (other == index) diff_array(PathPart{outer, name, 0}, of_a, of_b, report);
              }
              ++other;
            },
            b);
        ++index;
      },
      a);
}
}  // namespace detail

/// In the order in which the root hash takes them.
template <class S> void diff_states(const WorldState<S>& a, const WorldState<S>& b, DiffReport& report) {
  diff_value("settings", a.settings, b.settings, report);
  diff_value("tick", a.tick, b.tick, report);
  detail::diff_slots("body_slots", a.body_slots, b.body_slots, report);
  detail::diff_slots("shape_slots", a.shape_slots, b.shape_slots, report);
  detail::diff_slots("joint_slots", a.joint_slots, b.joint_slots, report);
  detail::diff_sections(nullptr, a, b, report);
  const PathPart frozen{nullptr, "frozen", 0};
  if (a.frozen.size() != b.frozen.size()) {
    report.add(PathPart{&frozen, "count", 0}, kLeafFormat<std::uint64_t>, a.frozen.size(), b.frozen.size());
  }
  for (std::size_t i = 0; i < a.frozen.size() && i < b.frozen.size(); ++i) {
    const PathPart island{&frozen, nullptr, i};
    detail::diff_sections(&island, *a.frozen[i], *b.frozen[i], report);
  }
}

/// Whom an index of an awake array belongs to: "body slot 17", "body slots 3 and 9"; empty for other paths.
template <class S> std::string owner_of(const WorldState<S>& state, std::string_view path) {
  const std::size_t open = path.find('['), close = path.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos) return {};
  const std::string_view name = path.substr(0, open);
  std::size_t index = 0;
  for (const char c : path.substr(open + 1, close - open - 1)) index = 10 * index + static_cast<std::size_t>(c - '0');
  if ((name == "bodies" || name == "properties") && index < state.awake.states.size()) {
    return "body slot " + std::to_string(state.awake.states[index].slot);
  }
  if (name == "contacts" && index < state.contacts.size()) {
    const ContactKey& key = state.contacts[index].key;
    return "body slots " + std::to_string(key.body_a) + " and " + std::to_string(key.body_b);
  }
  if ((name == "joints" || name == "joint_properties") && index < state.joints.states.size()) {
    return "joint slot " + std::to_string(state.joints.states[index].slot);
  }
  return {};
}

}  // namespace isostep::tool
