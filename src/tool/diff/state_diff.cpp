// The comparison of two states, row by row.
// SPDX-License-Identifier: MIT
#include "state_diff.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "path_item.hpp"
#include "state_rows.hpp"

namespace isostep::tool {
namespace {

std::string name_of(const RowKey& key) {
  const std::string text = "slot_" + std::to_string(key.slots[0]);
  return key.slots[1] == RowKey::kNoSlot ? text : text + "_" + std::to_string(key.slots[1]);
}

class StateDiffer {
 public:
  StateDiffer(const PathPart* outer, const StateRows& a, const StateRows& b, DiffReport& report)
      : outer_(outer), a_(a), b_(b), report_(report) {}

  void run() {
    for (std::size_t i = 0; i < a_.members.size(); ++i) {
      const StateRows::Member &a = a_.members[i], &b = b_.members[i];
      if (a.islands.gather != nullptr) diff_islands(a.islands, b.islands);
      else if (a.rows.is_list) diff_lists(a.rows, b.rows);
      else diff_rows(PathPart{outer_, a.rows.name.c_str(), 0}, a.rows, 0, b.rows, 0);
    }
  }

 private:
  /// The rows that have the keys of these: their own, or of properties their states'. Null: their index is their key.
  static const Rows* keys_of(const StateRows& of, const Rows& rows) {
    if (rows.key != nullptr) return &rows;
    constexpr std::pair<std::string_view, std::string_view> kProperties[] = {
        {"properties", "bodies"}, {"static_properties", "static_bodies"}, {"joint_properties", "joints"}};
    for (const auto& [properties, states] : kProperties) {
      if (rows.name != properties) continue;
      for (const StateRows::Member& member : of.members) {
        if (member.rows.name == states && member.rows.key != nullptr) return &member.rows;
      }
    }
    return nullptr;
  }
  static RowKey key(const Rows* keys, std::size_t i) {
    return keys == nullptr ? RowKey{{static_cast<std::uint32_t>(i), RowKey::kNoSlot}} : keys->key(keys->rows, i);
  }

  void diff_count(const PathPart& path, std::size_t a, std::size_t b) {
    if (a != b) report_.add(PathPart{&path, "count", 0}, kFieldFormat<std::uint64_t>, a, b);
  }
  void diff_rows(const PathPart& path, const Rows& a, std::size_t i, const Rows& b, std::size_t j) {
    row_a_.resize(a.type->size);
    row_b_.resize(a.type->size);
    a.pack(a.rows, i, row_a_.data());
    b.pack(b.rows, j, row_b_.data());
    diff_bytes(path, *a.type, row_a_.data(), row_b_.data(), report_);
  }
  /// Rows with keys of their own that one list alone has are differences, too.
  void diff_lists(const Rows& a, const Rows& b) {
    const PathPart path{outer_, a.name.c_str(), 0};
    const Rows* const keys_a = keys_of(a_, a);
    const Rows* const keys_b = keys_of(b_, b);
    diff_count(path, a.count, b.count);
    std::size_t i = 0, j = 0;
    while (i < a.count || j < b.count) {
      const bool of_a = i < a.count && (j == b.count || key(keys_a, i) <= key(keys_b, j));
      const bool of_b = j < b.count && (i == a.count || key(keys_b, j) <= key(keys_a, i));
      if (of_a && of_b) diff_rows(PathPart{&path, nullptr, i}, a, i, b, j);
      else if (a.key != nullptr) report_alone(path, of_a ? key(keys_a, i) : key(keys_b, j), of_a);
      i += of_a ? 1 : 0;
      j += of_b ? 1 : 0;
    }
  }
  void report_alone(const PathPart& path, const RowKey& key, bool in_a) {
    const std::string name = name_of(key);
    const PathPart row{&path, name.c_str(), 0};
    report_.add(PathPart{&row, "present", 0}, kFieldFormat<std::uint32_t>, in_a ? 1 : 0, in_a ? 0 : 1);
  }

  /// Islands are the same by their first body, shapes by their slot.
  void diff_islands(const Islands& a, const Islands& b) {
    const PathPart path{outer_, a.name.c_str(), 0};
    diff_count(path, a.objects.size(), b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
      const void* const same = same_in(b, i, a);
      if (same == nullptr || same == a.objects[i]) continue;
      StateRows of_a, of_b;
      a.gather(a.objects[i], of_a);
      b.gather(same, of_b);
      const PathPart item{&path, nullptr, i};
      StateDiffer(&item, of_a, of_b, report_).run();
    }
  }
  static const void* same_in(const Islands& list, std::size_t i, const Islands& of) {
    if (of.first_slot == nullptr) return i < list.objects.size() ? list.objects[i] : nullptr;
    const std::uint32_t slot = of.first_slot(of.objects[i]);
    if (slot == RowKey::kNoSlot) return nullptr;
    const auto same = std::find_if(list.objects.begin(), list.objects.end(),
                                   [&](const void* object) { return list.first_slot(object) == slot; });
    return same == list.objects.end() ? nullptr : *same;
  }

  const PathPart* outer_;
  const StateRows &a_, &b_;
  DiffReport& report_;
  std::vector<std::uint8_t> row_a_, row_b_;
};

template <class State> StateRows rows_of(const State& state) {
  StateRows rows;
  RowGatherer gatherer(rows);
  State::members(gatherer, state);
  return rows;
}

}  // namespace

template <class State> void diff_states(const State& a, const State& b, DiffReport& report) {
  const StateRows of_a = rows_of(a), of_b = rows_of(b);
  StateDiffer(nullptr, of_a, of_b, report).run();
}

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

template <class S> std::string owner_of(const ParticleState<S>& state, std::string_view path) {
  const auto [name, index] = first_item(path);
  for (const char* of_particles : {"position.x", "position.y", "position.z", "velocity.x", "velocity.y", "velocity.z",
                                   "inverse_mass", "material"}) {
    if (name == of_particles) return "particle slot " + std::to_string(index);
  }
  if (name == "contacts" && index < state.contacts.size())
    return "particle slot " + std::to_string(state.contacts[index].a);
  return {};
}

#define ISO_INSTANTIATE(S)                                                                  \
  template void diff_states(const WorldState<S>&, const WorldState<S>&, DiffReport&);       \
  template void diff_states(const ParticleState<S>&, const ParticleState<S>&, DiffReport&); \
  template std::string owner_of(const WorldState<S>&, std::string_view);                    \
  template std::string owner_of(const ParticleState<S>&, std::string_view);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::tool
