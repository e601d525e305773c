// The visitor that takes engines apart into fields. For files that instantiate an engine's walk; all of it has internal
// linkage, so no two objects share a symbol of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "isostep/core/slot_map.hpp"
#include "isostep/state/fields.hpp"

namespace isostep {
namespace {

/// A list of fields: a vector, a span, an array in pages.
template <class T>
concept FieldList = requires(T& list) {
  list.size();
  list[0];
};

/// A copy of a part of T, which is const if T is.
template <class T, class Part> using ConstAs = std::conditional_t<std::is_const_v<T>, const Part, Part>;

/// Calls a sink for every field.
struct FieldReading {
  static constexpr bool kEdits = false;
  const FieldSink& sink;

  void operator()(const PathPart& path, FieldFormat format, std::uint64_t bits) const {
    sink.field(sink.user, path, format, bits);
  }
};

template <class Visitor, class T> void walk_fields(const PathPart& path, const Visitor& visit, T& value);

/// Visits a number, a struct with `fields`, an array or a list of such, by visit("name", value). `Access` is
/// FieldReading, or with kEdits returns the bits that a field is to have; fields that are not const get them.
template <class Access> class FieldVisitor {
 public:
  static constexpr bool kEdits = Access::kEdits;

  FieldVisitor(const PathPart* outer, const Access& access) : outer_(outer), access_(access) {}
  FieldVisitor(const PathPart& outer, const FieldVisitor& other) : FieldVisitor(&outer, other.access_) {}

  template <class T> void operator()(const char* name, T&& value) const {
    walk_fields(PathPart{outer_, name, 0}, *this, value);
  }
  /// Visits items that are made only to be visited, or of which not all exist: each(visitor of the item, index).
  template <class Each> void each(const char* name, std::size_t count, Each&& each) const {
    const PathPart list{outer_, name, 0};
    tell_count(list, count);
    for (std::size_t i = 0; i < count; ++i) {
      const PathPart item{&list, nullptr, i};
      each(FieldVisitor(item, *this), i);
    }
  }
  /// Visits one item by itself, under the index that it has elsewhere.
  template <class Each> void one(const char* name, std::size_t index, Each&& each) const {
    const PathPart list{outer_, name, 0};
    const PathPart item{&list, nullptr, index};
    each(FieldVisitor(item, *this));
  }
  void tell_count(const PathPart& list, std::size_t count) const {
    const auto words = static_cast<std::uint64_t>(count);
    field(PathPart{&list, "count", 0}, words);
  }

  template <class T> void field(const PathPart& path, T& value) const {
    using Bare = std::remove_const_t<T>;
    visit_bits(path, kFieldFormat<Bare>, value, field_bits(value),
               [](std::uint64_t wanted) { return field_from_bits<Bare>(static_cast<FieldBits<Bare>>(wanted)); });
  }
  /// Visits a fixed-point format that is no Scalar by itself: steps of time.
  template <class T> void fixed_field(const PathPart& path, T& value) const {
    using Bare = std::remove_const_t<T>;
    using Raw = typename Bare::Raw;
    constexpr FieldFormat format = {FieldKind::scalar, sizeof(Raw), ScalarTraits<Bare>::kId};
    visit_bits(path, format, value, field_bits(value.raw()), [](std::uint64_t wanted) {
      return Bare::from_raw(field_from_bits<Raw>(static_cast<FieldBits<Raw>>(wanted)));
    });
  }
  /// Visits a named part of what is visited.
  template <class Inside> void within(const char* name, const Inside& inside) const {
    const PathPart part{outer_, name, 0};
    inside(FieldVisitor(part, *this));
  }

 private:
  template <class T, class FromBits>
  void visit_bits(const PathPart& path, FieldFormat format, T& value, std::uint64_t bits, FromBits&& from_bits) const {
    if constexpr (!kEdits) {
      access_(path, format, bits);
    } else if constexpr (!std::is_const_v<T>) {
      const std::uint64_t wanted = access_(path, format, bits);
      if (wanted != bits) value = from_bits(wanted);
    }
  }

  const PathPart* outer_;
  const Access& access_;
};

template <class Visitor, class T> void walk_fields(const PathPart& path, const Visitor& visit, T& value) {
  using Bare = std::remove_const_t<T>;
  if constexpr (std::is_bounded_array_v<Bare>) {
    if constexpr (std::extent_v<Bare> == 1) {  // a block of one lane
      walk_fields(path, visit, value[0]);
    } else {
      for (std::size_t i = 0; i < std::extent_v<Bare>; ++i) {
        walk_fields(PathPart{&path, nullptr, i}, visit, value[i]);
      }
    }
  } else if constexpr (HasFields<Bare>) {
    Bare::fields(Visitor(path, visit), value);
  } else if constexpr (FieldValue<Bare>) {
    visit.field(path, value);
  } else if constexpr (FieldList<Bare>) {
    visit.tell_count(path, value.size());
    for (std::size_t i = 0; i < value.size(); ++i) walk_fields(PathPart{&path, nullptr, i}, visit, value[i]);
  } else if constexpr (requires { typename Bare::Raw; }) {
    visit.fixed_field(path, value);
  } else if constexpr (requires { value.value(); }) {  // Exact
    ConstAs<T, decltype(value.value())> bare = value.value();
    visit.field(path, bare);
    if constexpr (Visitor::kEdits && !std::is_const_v<T>) value = Bare(bare);
  } else if constexpr (sizeof(value.raw) <= 8) {  // a sum of products
    visit.field(path, value.raw);
  } else {
    ConstAs<T, UInt128Parts> words = parts(value.raw);
    visit.field(PathPart{&path, "high", 0}, words.high);
    visit.field(PathPart{&path, "low", 0}, words.low);
    if constexpr (Visitor::kEdits && !std::is_const_v<T>) value.raw = int128_from(words);
  }
}

/// Visits a whole state field by field, see members.hpp. What copies of a state share is copied before it is written;
/// islands are never written.
template <class Visitor> class StateFields {
 public:
  explicit StateFields(const Visitor& visit) : visit_(visit) {}

  template <class T> void operator()(const char* name, T& value) const {
    if constexpr (std::is_same_v<std::remove_const_t<T>, SlotMap>) {
      visit_slots(name, value);
    } else if constexpr (requires { value.all(); }) {  // Registry
      visit_slots((std::string(name) + "_slots").c_str(), std::as_const(value).slot_map());
      if constexpr (Visitor::kEdits) visit_(name, value.change_all());
      else visit_(name, std::as_const(value).all());
    } else {
      visit_(name, value);
    }
  }
  template <class List> void bodies_in_pages(List& list) const {
    if constexpr (Visitor::kEdits) list.change_arrays(visit_);
    else list.arrays(visit_);
  }
  template <class Records, class Parts> void records(Records& value, Parts& parts) const {
    using Value = std::remove_cvref_t<decltype(*value)>;
    const std::uint32_t kinds = value->kinds();
    if (kinds == 0) return;
    if constexpr (Visitor::kEdits) Value::members_of(kinds, *this, value.change(), parts);
    else Value::members_of(kinds, *this, *value, parts);
  }
  template <class Store> void store(const char* name, const Store& value) const { visit_(name, value->names()); }
  template <class List> void islands(const char* name, const List& list) const {
    visit_.each(name, list.size(), [&](const Visitor& of_island, std::size_t i) {
      const auto& island = *list[i];
      std::remove_cvref_t<decltype(island)>::sections(of_island, island);
    });
  }

 private:
  void visit_slots(const char* name, const SlotMap& slot_map) const {
    visit_.within(name, [&](const Visitor& of_slots) {
      const std::uint32_t first_free = slot_map.first_free();
      of_slots("first_free", first_free);
    });
    visit_(name, slot_map.entries());
  }

  const Visitor& visit_;
};

}  // namespace
}  // namespace isostep
