// join_lists: one ascending list of two, each of which has the records that it owns.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep::detail {

/// Calls take(list, first, end) for runs of records, together ascending by key: those of `fresh` that `owns` accepts,
/// and those of `old` that it does not. Both lists ascend.
template <class List, class Key, class Owns, class Take>
ISO_INLINE void join_runs(const List& old, const List& fresh, const Key& key, const Owns& owns, const Take& take) {
  std::size_t i = 0, j = 0;
  while (true) {
    while (i < old.size() && owns(old[i])) ++i;
    while (j < fresh.size() && !owns(fresh[j])) ++j;
    const std::size_t first = i;
    while (i < old.size() && !owns(old[i]) && (j == fresh.size() || key(old[i]) < key(fresh[j]))) ++i;
    if (first < i) {
      take(old, first, i);
    } else if (j < fresh.size()) {
      take(fresh, j, j + 1);
      ++j;
    } else {
      return;
    }
  }
}
template <class Record>
ISO_INLINE void append_run(std::vector<Record>& into, const std::vector<Record>& from, std::size_t first,
                           std::size_t end) {
  into.insert(into.end(), from.data() + first, from.data() + end);
}
/// Fills `into` with the records of both lists.
template <class Record, class Key, class Owns>
ISO_INLINE void join_lists(const std::vector<Record>& old, const std::vector<Record>& fresh, const Key& key,
                           const Owns& owns, std::vector<Record>& into) {
  into.clear();
  join_runs(old, fresh, key, owns,
            [&](const std::vector<Record>& from, std::size_t first, std::size_t end)
                ISO_INLINE_LAMBDA { append_run(into, from, first, end); });
}

/// Overwrites the records of `list` that `owns` accepts by those of `fresh`: calls put(i, j). Returns false where their
/// keys differ, with some of them overwritten.
template <class List, class Key, class Owns, class Put>
ISO_INLINE bool overwrite(const List& list, const List& fresh, const Key& key, const Owns& owns, const Put& put) {
  std::size_t j = 0;
  const auto next = [&]() ISO_INLINE_LAMBDA {
    while (j < fresh.size() && !owns(fresh[j])) ++j;
  };
  next();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!owns(list[i])) continue;
    if (j == fresh.size() || key(list[i]) < key(fresh[j]) || key(fresh[j]) < key(list[i])) return false;
    put(i, j++);
    next();
  }
  return j == fresh.size();
}
/// Replaces the records of `list` that `owns` accepts by those of `fresh`, in place where the same are there.
template <class Record, class Key, class Owns>
ISO_INLINE void replace_owned(std::vector<Record>& list, const std::vector<Record>& fresh, const Key& key,
                              const Owns& owns, std::vector<Record>& scratch) {
  const auto put = [&](std::size_t i, std::size_t j) ISO_INLINE_LAMBDA { list[i] = fresh[j]; };
  if (overwrite(list, fresh, key, owns, put)) return;
  join_lists(list, fresh, key, owns, scratch);
  list.swap(scratch);
}

/// A row of two arrays side by side.
template <class Set> struct SetRow {
  const Set* set;
  std::size_t index;
  ISO_INLINE std::uint32_t slot() const { return set->states[index].slot; }
  ISO_INLINE const auto& properties() const { return set->properties[index]; }
};
template <class Set> struct SetRows {
  const Set* set;
  ISO_INLINE std::size_t size() const { return set->states.size(); }
  ISO_INLINE SetRow<Set> operator[](std::size_t i) const { return {set, i}; }
};
/// Does so for records with `slot` in `states`, and beside them those in `properties`. Returns false if others are
/// there than before.
template <class Set, class Owns>
ISO_INLINE bool replace_owned_rows(Set& set, const Set& fresh, const Owns& owns, Set& scratch) {
  using Rows = SetRows<Set>;
  const auto slot_of = [](SetRow<Set> row) ISO_INLINE_LAMBDA { return row.slot(); };
  const auto put = [&](std::size_t i, std::size_t j) ISO_INLINE_LAMBDA {
    set.states[i] = fresh.states[j];
    set.properties[i] = fresh.properties[j];
  };
  if (overwrite(Rows{&set}, Rows{&fresh}, slot_of, owns, put)) return true;
  scratch.states.clear();
  scratch.properties.clear();
  join_runs(Rows{&set}, Rows{&fresh}, slot_of, owns,
            [&](Rows from, std::size_t first, std::size_t end) ISO_INLINE_LAMBDA {
              append_run(scratch.states, from.set->states, first, end);
              append_run(scratch.properties, from.set->properties, first, end);
            });
  set.states.swap(scratch.states);
  set.properties.swap(scratch.properties);
  return false;
}

}  // namespace isostep::detail
