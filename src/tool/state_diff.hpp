// All differences of two world states, by name.
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// Whose a row is, alike in every state: two slots, and the parts of their bodies. Rows ascend by it.
struct RowKey {
  std::uint32_t slots[2] = {kNoSlot, kNoSlot}, parts[2] = {};
  static constexpr std::uint32_t kNoSlot = 0xffffffffu;

  friend auto operator<=>(const RowKey&, const RowKey&) = default;
  std::string name() const {
    std::string text = "slot_" + std::to_string(slots[0]);
    return slots[1] == kNoSlot ? text : text + "_" + std::to_string(slots[1]);
  }
};
template <class S> RowKey key_of(const BodyState<S>& body) { return {{body.slot, RowKey::kNoSlot}}; }
template <class S> RowKey key_of(const JointState<S>& joint) { return {{joint.slot, RowKey::kNoSlot}}; }
template <class S> RowKey key_of(const PendingForce<S>& force) { return {{force.slot, RowKey::kNoSlot}}; }
template <class S> RowKey key_of(const Contact<S>& contact) {
  return {{contact.key.body_a, contact.key.body_b}, {contact.key.child_a, contact.key.child_b}};
}
inline RowKey key_of(const SensorOverlap& overlap) { return {{overlap.sensor, overlap.other}}; }

/// The rows of two arrays that have one key; where an array has no keys, of one index.
template <class Array> class RowPairs {
 public:
  RowPairs(const std::vector<RowKey>* keys_a, const std::vector<RowKey>* keys_b) : a_(keys_a), b_(keys_b) {}

  /// `report_lonely`: rows of one array alone are differences, too.
  void diff(const PathPart& path, const Array& a, const Array& b, bool report_lonely, DiffReport& report) const {
    if (a.size() != b.size()) report.add(PathPart{&path, "count", 0}, kLeafFormat<std::uint64_t>, a.size(), b.size());
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
      const bool of_a = i < a.size() && (j == b.size() || key(a_, i) <= key(b_, j));
      const bool of_b = j < b.size() && (i == a.size() || key(b_, j) <= key(a_, i));
      if (of_a && of_b) {
        diff_value(PathPart{&path, nullptr, i}, a[i], b[j], report);
      } else if (report_lonely) {
        const std::string name = (of_a ? key(a_, i) : key(b_, j)).name();
        const PathPart row{&path, name.c_str(), 0};
        report.add(PathPart{&row, "present", 0}, kLeafFormat<std::uint32_t>, of_a ? 1 : 0, of_b ? 1 : 0);
      }
      i += of_a ? 1 : 0;
      j += of_b ? 1 : 0;
    }
  }

 private:
  static RowKey key(const std::vector<RowKey>* keys, std::size_t i) {
    return keys == nullptr ? RowKey{{static_cast<std::uint32_t>(i), RowKey::kNoSlot}} : (*keys)[i];
  }
  const std::vector<RowKey>* a_;
  const std::vector<RowKey>* b_;
};

/// The keys of an object's sections by their names, rows of properties by their states'.
template <class Object> class SectionKeys {
 public:
  explicit SectionKeys(const Object& object) {
    Object::sections(
        [&](const char* name, const auto& rows) {
          if constexpr (requires { key_of(rows[0]); }) {
            std::vector<RowKey>& keys = all_[name];
            for (const auto& row : rows) keys.push_back(key_of(row));
          }
        },
        object);
  }
  const std::vector<RowKey>* find(const std::string& name) const {
    constexpr std::pair<const char*, const char*> kProperties[] = {
        {"properties", "bodies"}, {"fixed_properties", "fixed"}, {"joint_properties", "joints"}};
    for (const auto& [properties, states] : kProperties) {
      if (name == properties) return find(states);
    }
    const auto found = all_.find(name);
    return found == all_.end() ? nullptr : &found->second;
  }
  /// Not of properties, whose states tell it.
  bool has(const std::string& name) const { return all_.count(name) != 0; }

 private:
  std::map<std::string, std::vector<RowKey>> all_;
};

/// Walks two objects' sections side by side.
template <class Object>
void diff_sections(const PathPart* outer, const Object& a, const Object& b, DiffReport& report) {
  const SectionKeys<Object> keys_a(a), keys_b(b);
  std::size_t index = 0;
  Object::sections(
      [&](const char* name, const auto& of_a) {
        std::size_t other = 0;
        Object::sections(
            [&](const char*, const auto& of_b) {
              if constexpr (std::is_same_v<decltype(of_a), decltype(of_b)>) {
                if (other == index) {
                  RowPairs<std::remove_cvref_t<decltype(of_a)>>(keys_a.find(name), keys_b.find(name))
                      .diff(PathPart{outer, name, 0}, of_a, of_b, keys_a.has(name), report);
                }
              }
              ++other;
            },
            b);
        ++index;
      },
      a);
}

/// Of the island that has the body, or null.
template <class S> const FrozenIsland<S>* island_of(const WorldState<S>& state, std::uint32_t slot) {
  for (std::size_t i = 0; i < state.frozen.size(); ++i) {
    const auto& bodies = state.frozen[i]->bodies.states;
    if (!bodies.empty() && bodies.front().slot == slot) return state.frozen[i].get();
  }
  return nullptr;
}
}  // namespace detail

/// In the order in which the root hash takes them; rows by whose they are, for others may be awake in each.
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
  for (std::size_t i = 0; i < a.frozen.size(); ++i) {
    const PathPart island{&frozen, nullptr, i};
    const auto& bodies = a.frozen[i]->bodies.states;
    const FrozenIsland<S>* const other = bodies.empty() ? nullptr : detail::island_of(b, bodies.front().slot);
    if (other != nullptr && other != a.frozen[i].get()) detail::diff_sections(&island, *a.frozen[i], *other, report);
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
