// All differences of two states of worlds, by name.
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isostep/state/diff.hpp"
#include "isostep/store/state.hpp"
#include "path_item.hpp"

namespace isostep::tool {

namespace detail {
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

/// Every kind of records, whichever the state has: two states are visited alike.
template <class Visitor, class Records, class Parts>
void members_of_all(Visitor& visit, const Records& records, const Parts& parts) {
  Records::members_of((1u << Records::kKinds) - 1, visit, records, parts);
}

/// The rows of two arrays that have one key; where an array has no keys, of one index.
template <class Array> class RowPairs {
 public:
  RowPairs(const std::vector<RowKey>* keys_a, const std::vector<RowKey>* keys_b) : a_(keys_a), b_(keys_b) {}

  /// `report_lonely`: rows of one array alone are differences, too.
  void diff(const PathPart& path, const Array& a, const Array& b, bool report_lonely, DiffReport& report) const {
    if (a.size() != b.size()) report.add(PathPart{&path, "count", 0}, kFieldFormat<std::uint64_t>, a.size(), b.size());
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
      const bool of_a = i < a.size() && (j == b.size() || key(a_, i) <= key(b_, j));
      const bool of_b = j < b.size() && (i == a.size() || key(b_, j) <= key(a_, i));
      if (of_a && of_b) {
        diff_value(PathPart{&path, nullptr, i}, a[i], b[j], report);
      } else if (report_lonely) {
        const std::string name = (of_a ? key(a_, i) : key(b_, j)).name();
        const PathPart row{&path, name.c_str(), 0};
        report.add(PathPart{&row, "present", 0}, kFieldFormat<std::uint32_t>, of_a ? 1 : 0, of_b ? 1 : 0);
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

/// The keys of an object's rows by the names of their arrays, rows of properties by their states'.
class RowKeys {
 public:
  template <class Rows> void operator()(const char* name, const Rows& rows) {
    if constexpr (requires { key_of(rows[0]); }) {
      std::vector<RowKey>& keys = all_[name];
      for (std::size_t i = 0; i < rows.size(); ++i) keys.push_back(key_of(rows[i]));
    }
  }
  template <class List> void bodies_in_pages(const List& list) { list.arrays(*this); }
  template <class List> void islands(const char*, const List&) {}
  template <class Records, class Parts> void records(const Records& value, const Parts& parts) {
    members_of_all(*this, *value, parts);
  }
  template <class Store> void store(const char*, const Store&) {}

  const std::vector<RowKey>* find(const std::string& name) const {
    constexpr std::pair<const char*, const char*> kProperties[] = {
        {"properties", "bodies"}, {"static_properties", "static_bodies"}, {"joint_properties", "joints"}};
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

/// What an object's visit names, in its order.
struct MemberList {
  std::vector<const void*> members;
  template <class T> void operator()(const char*, const T& member) { members.push_back(&member); }
  template <class List> void bodies_in_pages(const List& list) { members.push_back(&list); }
  template <class List> void islands(const char*, const List& list) { members.push_back(&list); }
  template <class Records, class Parts> void records(const Records& value, const Parts& parts) {
    members_of_all(*this, *value, parts);
  }
  template <class Store> void store(const char*, const Store& value) { members.push_back(&value); }
};

/// Visits one object beside another of its type, whose members come in the same order: walk(visitor, object).
class StateDiffer {
 public:
  template <class Object, class Walk>
  StateDiffer(const PathPart* outer, const Walk& walk, const Object& a, const Object& b, DiffReport& report)
      : outer_(outer), report_(report) {
    walk(keys_a_, a);
    walk(keys_b_, b);
    walk(others_, b);
    walk(*this, a);
  }

  template <class T> void operator()(const char* name, const T& a) {
    const T& b = other(a);
    const PathPart path{outer_, name, 0};
    if constexpr (std::is_same_v<T, SlotMap>) {
      slots(path, a, b);
    } else if constexpr (requires { a.all(); }) {  // Registry
      slots(PathPart{outer_, (std::string(name) + "_slots").c_str(), 0}, a.slot_map(), b.slot_map());
      rows(path, name, a.all(), b.all());
    } else if constexpr (requires { a.size(); }) {
      rows(path, name, a, b);
    } else {
      diff_value(path, a, b, report_);
    }
  }
  template <class List> void bodies_in_pages(const List& list) {
    const List& b = other(list);
    list.arrays([&](const char* name, const auto& of_a) {
      b.arrays([&](const char* name_b, const auto& of_b) {
        if constexpr (std::is_same_v<decltype(of_a), decltype(of_b)>) {
          if (std::string_view(name) == name_b) rows(PathPart{outer_, name, 0}, name, of_a, of_b);
        }
      });
    });
  }
  template <class Records, class Parts> void records(const Records& value, const Parts& parts) {
    members_of_all(*this, *value, parts);
  }
  template <class Store> void store(const char* name, const Store& a) {
    rows(PathPart{outer_, name, 0}, name, a->names(), other(a)->names());
  }
  /// Islands are the same by their first body, shapes by their slot.
  template <class List> void islands(const char* name, const List& a) {
    const List& b = other(a);
    const PathPart path{outer_, name, 0};
    count(path, a, b);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const PathPart item{&path, nullptr, i};
      using Island = std::remove_cvref_t<decltype(*a[i])>;
      const Island* const same = same_in(b, i, *a[i]);
      if (same == nullptr || same == a[i].get()) continue;
      const auto walk = [](auto& visit, const Island& island) { Island::sections(visit, island); };
      StateDiffer(&item, walk, *a[i], *same, report_);
    }
  }

 private:
  template <class T> const T& other(const T&) { return *static_cast<const T*>(others_.members[next_++]); }
  template <class List> void count(const PathPart& path, const List& a, const List& b) {
    if (a.size() != b.size()) report_.add(PathPart{&path, "count", 0}, kFieldFormat<std::uint64_t>, a.size(), b.size());
  }
  template <class Rows> void rows(const PathPart& path, const char* name, const Rows& a, const Rows& b) {
    RowPairs<Rows>(keys_a_.find(name), keys_b_.find(name)).diff(path, a, b, keys_a_.has(name), report_);
  }
  void slots(const PathPart& path, const SlotMap& a, const SlotMap& b) {
    diff_value(PathPart{&path, "first_free", 0}, a.first_free(), b.first_free(), report_);
    RowPairs<SlotMap::Entries>(nullptr, nullptr).diff(path, a.entries(), b.entries(), false, report_);
  }
  /// What stands for a[i] in the other list, or null.
  template <class List, class Island>
  static const Island* same_in(const List& list, std::size_t i, const Island& island) {
    if constexpr (requires { island.bodies; }) {
      return island.bodies.states.empty() ? nullptr : island_of(list, island.bodies.states.front().slot);
    } else {
      return i < list.size() ? list[i].get() : nullptr;
    }
  }
  /// Of the island that has the body, or null.
  template <class List> static auto island_of(const List& list, std::uint32_t slot) -> decltype(list[0].get()) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto& bodies = list[i]->bodies.states;
      if (!bodies.empty() && bodies.front().slot == slot) return list[i].get();
    }
    return nullptr;
  }

  const PathPart* outer_;
  DiffReport& report_;
  RowKeys keys_a_, keys_b_;
  MemberList others_;
  std::size_t next_ = 0;
};
}  // namespace detail

/// All differences of two states of one kind of world, in the order in which the state hash takes them; rows by whose
/// they are, for others may be awake in each.
template <class State> void diff_states(const State& a, const State& b, DiffReport& report) {
  const auto walk = [](auto& visit, const State& state) { State::members(visit, state); };
  detail::StateDiffer(nullptr, walk, a, b, report);
}

/// Whom an index of an awake array belongs to: "body slot 17", "body slots 3 and 9"; empty for other paths.
template <class S> std::string owner_of(const WorldState<S>& state, std::string_view path) {
  const auto [name, index] = first_item(path);
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
