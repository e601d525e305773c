// The rows of a state without their types: names, tables of fields, and how to get at a row's bytes and its owner.
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "isostep/core/registry.hpp"
#include "isostep/core/slot_map.hpp"
#include "isostep/state/field_table.hpp"
#include "isostep/store/state.hpp"

namespace isostep::tool {

/// The owner of a row, alike in every state: two slots, and the parts of their bodies. Rows ascend by it.
struct RowKey {
  std::uint32_t slots[2] = {kNoSlot, kNoSlot}, parts[2] = {};
  static constexpr std::uint32_t kNoSlot = 0xffffffffu;

  friend auto operator<=>(const RowKey&, const RowKey&) = default;
};
template <class S> RowKey key_of(const BodyState<S>& body) { return {{body.slot, RowKey::kNoSlot}}; }
template <class S> RowKey key_of(const JointState<S>& joint) { return {{joint.slot, RowKey::kNoSlot}}; }
template <class S> RowKey key_of(const PendingForce<S>& force) { return {{force.slot, RowKey::kNoSlot}}; }
template <class S> RowKey key_of(const Contact<S>& contact) {
  return {{contact.key.body_a, contact.key.body_b}, {contact.key.child_a, contact.key.child_b}};
}
inline RowKey key_of(const SensorOverlap& overlap) {
  return {{overlap.sensor, overlap.other}, {overlap.sensor_child, overlap.other_child}};
}

/// Rows of one type, or a value by itself. Refers to the state that it was made of.
struct Rows {
  std::string name;
  const FieldType* type;
  bool is_list;
  std::size_t count;
  const void* rows;
  void (*pack)(const void* rows, std::size_t row, std::uint8_t* canonical);
  RowKey (*key)(const void* rows, std::size_t row);  // null: rows have none of their own
  std::shared_ptr<const void> owner = nullptr;       // of a list that is no part of the state
};

struct StateRows;
/// Immutable objects that are shared by copies of a state: islands that sleep, shapes.
struct Islands {
  std::string name;
  std::vector<const void*> objects;
  std::uint32_t (*first_slot)(const void* object);  // of its bodies; null: an object has none, its index tells which
  void (*gather)(const void* object, StateRows& rows);
};

/// The parts of a state or an island, in the order of its hash: rows, and behind each its islands, if it has some.
struct StateRows {
  struct Member {
    Rows rows;
    Islands islands;  // instead of rows, where `gather` is not null
  };
  std::vector<Member> members;
};

/// The visitor of `members` and `sections` that gathers rows.
class RowGatherer {
 public:
  explicit RowGatherer(StateRows& out) : out_(out) {}

  template <class T> void operator()(const char* name, const T& value) {
    if constexpr (std::is_same_v<T, SlotMap>) {
      slots(name, value);
    } else if constexpr (requires { value.all(); }) {  // Registry
      slots(std::string(name) + "_slots", value.slot_map());
      list(name, value.all());
    } else if constexpr (requires { value.size(); }) {
      list(name, value);
    } else {
      const auto pack_value = [](const void* at, std::size_t, std::uint8_t* canonical) {
        pack(canonical, *static_cast<const T*>(at));
      };
      add({name, &kFieldType<T>, false, 1, &value, pack_value, nullptr});
    }
  }
  template <class List> void bodies_in_pages(const List& bodies) {
    bodies.arrays([&](const char* name, const auto& rows) {
      const auto kept = std::make_shared<std::remove_cvref_t<decltype(rows)>>(rows);  // the list lasts for this call
      list(name, *kept);
      out_.members.back().rows.owner = kept;
    });
  }
  template <class Records, class Parts> void records(const Records& value, const Parts& parts) {
    using Store = std::remove_cvref_t<decltype(*value)>;
    Store::members_of((1u << Store::kKinds) - 1, *this, *value, parts);  // all: two states are gathered alike
  }
  template <class Store> void store(const char* name, const Store& value) { list(name, value->names()); }
  template <class List> void islands(const char* name, const List& objects) {
    using Island = std::remove_cvref_t<decltype(*objects[0])>;
    Islands all{name, {}, nullptr, [](const void* object, StateRows& rows) {
                  RowGatherer gatherer(rows);
                  Island::sections(gatherer, *static_cast<const Island*>(object));
                }};
    for (std::size_t i = 0; i < objects.size(); ++i) all.objects.push_back(objects[i].get());
    if constexpr (requires(const Island& island) { island.bodies; }) {
      all.first_slot = [](const void* object) {
        const auto& bodies = static_cast<const Island*>(object)->bodies.states;
        return bodies.empty() ? RowKey::kNoSlot : bodies.front().slot;
      };
    }
    out_.members.push_back({{}, std::move(all)});
  }

 private:
  void add(Rows rows) { out_.members.push_back({std::move(rows), {}}); }
  template <class List> void list(std::string name, const List& rows) {
    using Row = std::remove_cvref_t<decltype(rows[0])>;
    const auto pack_row = [](const void* all, std::size_t row, std::uint8_t* canonical) {
      pack(canonical, (*static_cast<const List*>(all))[row]);
    };
    Rows erased{std::move(name), &kFieldType<Row>, true, rows.size(), &rows, pack_row, nullptr};
    if constexpr (requires(const Row& row) { key_of(row); }) {
      erased.key = [](const void* all, std::size_t row) { return key_of((*static_cast<const List*>(all))[row]); };
    }
    add(std::move(erased));
  }
  void slots(const std::string& name, const SlotMap& slot_map) {
    const auto pack_first_free = [](const void* at, std::size_t, std::uint8_t* canonical) {
      pack(canonical, static_cast<const SlotMap*>(at)->first_free());
    };
    add({name + ".first_free", &kFieldType<std::uint32_t>, false, 1, &slot_map, pack_first_free, nullptr});
    list(name, slot_map.entries());
  }

  StateRows& out_;
};

}  // namespace isostep::tool
