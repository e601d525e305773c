// The visitors of a whole state: its hash, its size, its writer and its reader.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "isostep/core/paged_array.hpp"
#include "isostep/core/registry.hpp"
#include "isostep/core/shared.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/hash.hpp"
#include "isostep/state/slots.hpp"

// A state names what it consists of once, in `members(visit, self)`, and everything that reads a state whole visits it:
// these here, the walk over fields (fields.inl) and the differ of the tool. Members have the order of the hash and of
// the portable form. A member is visited as one of
//   visit("name", value)         a record with `fields`, a number, a SlotMap, a Registry, or a vector of records
//   visit.bodies_in_pages(list)  StaticBodies, or another list of two arrays in pages that may be empty
//   visit.islands("name", list)  a PagedArray of immutable objects, each with `sections(visit, self)` and `hash`
//   visit.records(value, parts)  Shared<T>: a word of which kinds T::kinds there are, then the registries of those and
//                                what belongs to them in `parts`, which T::members_of visits
//   visit.store("name", value)   Shared<T>: names, by which content outside the state is known. Last of all

namespace isostep::detail {

/// Hashes an immutable object with `sections`.
template <class Island> ISO_INLINE std::uint64_t hash_sections(const Island& island) {
  HashCombiner combiner;
  Island::sections([&](const char*, const auto& array)
                       ISO_INLINE_LAMBDA { combiner.add(hash_records(array.data(), array.size())); },
                   island);
  return combiner.value();
}

/// Computes the state hash. Islands bring their own hashes. Each full page of islands that another page follows is one
/// word, because such pages rarely change.
class StateHasher {
 public:
  ISO_INLINE std::uint64_t value() const { return combiner_.value(); }

  ISO_INLINE void operator()(const char*, std::uint64_t number) { combiner_.add(number); }
  ISO_INLINE void operator()(const char*, const SlotMap& slot_map) { combiner_.add(hash_slots(slot_map)); }
  template <HasFields Record> ISO_INLINE void operator()(const char*, const Record& record) {
    combiner_.add(hash_records_by_fields(&record, 1));
  }
  template <class Record> ISO_INLINE void operator()(const char*, const std::vector<Record>& records) {
    if constexpr (kHasNoPadding<Record>) combiner_.add(hash_records(records.data(), records.size()));
    else combiner_.add(hash_records_by_fields(records.data(), records.size()));
  }
  template <class Record, class Id> ISO_INLINE void operator()(const char*, const Registry<Record, Id>& registry) {
    combiner_.add(hash_slots(registry.slot_map()));
    combiner_.add(registry.remembered().get(
        [&]() ISO_INLINE_LAMBDA { return hash_records_by_fields(registry.all().data(), registry.all().size()); }));
  }
  /// Hashes page by page, so that a change costs its page. Empty pages do not count.
  template <class List> ISO_INLINE void bodies_in_pages(const List& list) {
    combiner_.add(list.remembered_of_all(0).get([&]() ISO_INLINE_LAMBDA {
      HashCombiner all;
      for (std::size_t p = 0; p < list.pages(); ++p) {
        const auto& page = list.page(p);
        if (page.states.empty()) continue;
        all.add(list.remembered(p, 0).get(
            [&]() ISO_INLINE_LAMBDA { return hash_records(page.states.data(), page.states.size()); }));
        all.add(list.remembered(p, 1).get(
            [&]() ISO_INLINE_LAMBDA { return hash_records(page.properties.data(), page.properties.size()); }));
      }
      return all.value();
    }));
  }
  template <class List> ISO_INLINE void islands(const char*, const List& list) {
    const auto add_page = [&](HashCombiner& combiner, std::size_t p) ISO_INLINE_LAMBDA {
      for (std::size_t i = 0; i < list.page_size(p); ++i) combiner.add(list.page(p)[i]->hash);
    };
    if (list.empty()) return;
    for (std::size_t p = 0; p + 1 < list.pages(); ++p) {
      combiner_.add(list.remembered(p).get([&]() ISO_INLINE_LAMBDA {
        HashCombiner page;
        add_page(page, p);
        return page.value();
      }));
    }
    add_page(combiner_, list.pages() - 1);
  }
  template <class Records, class Parts> ISO_INLINE void records(const Shared<Records>& value, const Parts& parts) {
    const std::uint32_t kinds = value->kinds();
    combiner_.add(kinds);
    Records::members_of(kinds, *this, *value, parts);
  }
  template <class Store> ISO_INLINE void store(const char*, const Shared<Store>& value) {
    combiner_.add(value.remembered().get(
        [&]() ISO_INLINE_LAMBDA { return hash_records(value->names().data(), value->names().size()); }));
  }

 private:
  HashCombiner combiner_;
};

/// [bytes] The size of what a copy of a state holds for itself, without what it shares until one of the copies changes
/// it.
class StateSize {
 public:
  ISO_INLINE std::size_t value() const { return bytes_; }

  template <class T> ISO_INLINE void operator()(const char*, const T&) {}
  ISO_INLINE void operator()(const char*, const SlotMap& slot_map) {
    bytes_ += slot_map.entries().pages() * sizeof(void*);
  }
  template <class Record> ISO_INLINE void operator()(const char*, const std::vector<Record>& records) {
    bytes_ += records.size() * sizeof(Record);
  }
  template <class Record, class Id> ISO_INLINE void operator()(const char* name, const Registry<Record, Id>& registry) {
    (*this)(name, registry.slot_map());
  }
  template <class List> ISO_INLINE void bodies_in_pages(const List& list) { bytes_ += list.pages() * sizeof(void*); }
  template <class List> ISO_INLINE void islands(const char*, const List& list) {
    bytes_ += list.pages() * sizeof(void*);
  }
  template <class Records, class Parts> ISO_INLINE void records(const Shared<Records>& value, const Parts& parts) {
    Records::members_of(
        value->kinds(), [&](const char*, const auto& list) ISO_INLINE_LAMBDA { add(list); }, *value, parts);
  }
  template <class Store> ISO_INLINE void store(const char*, const Shared<Store>&) {}

 private:
  template <class Record> ISO_INLINE void add(const std::vector<Record>& list) { (*this)("", list); }
  template <class Record, class Id> ISO_INLINE void add(const Registry<Record, Id>&) {}

  std::size_t bytes_ = 0;
};

class StateWriter {
 public:
  ISO_INLINE explicit StateWriter(Writer& writer) : writer_(writer) {}

  template <class T> ISO_INLINE void operator()(const char*, const T& value) { writer_.write(value); }
  ISO_INLINE void operator()(const char*, const SlotMap& slot_map) { write_slots(writer_, slot_map); }
  template <class Record> ISO_INLINE void operator()(const char*, const std::vector<Record>& records) {
    writer_.write_array(records);
  }
  template <class Record, class Id> ISO_INLINE void operator()(const char*, const Registry<Record, Id>& registry) {
    write_slots(writer_, registry.slot_map());
    writer_.write_array(registry.all());
  }
  /// Writes the bodies as two arrays, in which pages do not show.
  template <class List> ISO_INLINE void bodies_in_pages(const List& list) {
    const auto write = [&](auto array) ISO_INLINE_LAMBDA {
      writer_.write_count(list.size());
      for (std::size_t p = 0; p < list.pages(); ++p) {
        const auto& records = list.page(p).*array;
        writer_.write_records(records.data(), records.size());
      }
    };
    write(&List::Page::states);
    write(&List::Page::properties);
  }
  template <class List> ISO_INLINE void islands(const char*, const List& list) {
    writer_.write_count(list.size());
    for (const auto& island : list) std::remove_cvref_t<decltype(*island)>::sections(*this, *island);
  }
  template <class Records, class Parts> ISO_INLINE void records(const Shared<Records>& value, const Parts& parts) {
    const std::uint32_t kinds = value->kinds();
    writer_.write(kinds);
    Records::members_of(kinds, *this, *value, parts);
  }
  template <class Store> ISO_INLINE void store(const char*, const Shared<Store>& value) { value->write(writer_); }

 private:
  Writer& writer_;
};

/// The ReadStore of a world that has no store.
struct ReadNoStore {
  template <class Store> ISO_INLINE void operator()(Store&) const {}
};
/// Reads into a new state. The result is well formed; the engine's validator tells if it is valid. `read_store` reads a
/// store, which it may change, when its turn comes.
template <class ReadStore = ReadNoStore> class StateReader {
 public:
  ISO_INLINE explicit StateReader(Reader& reader, ReadStore read_store = {})
      : reader_(reader), read_store_(std::move(read_store)) {}

  template <class T> ISO_INLINE void operator()(const char*, T& value) { reader_.read(value); }
  ISO_INLINE void operator()(const char*, SlotMap& slot_map) { read_slots(reader_, slot_map); }
  template <class Record> ISO_INLINE void operator()(const char*, std::vector<Record>& records) {
    reader_.read_array(records, kMaxRecords);
  }
  template <class Record, class Id> ISO_INLINE void operator()(const char*, Registry<Record, Id>& registry) {
    read_slots(reader_, registry.slot_map());
    reader_.read_array(registry.change_all(), kMaxRecords);
  }
  template <class List> ISO_INLINE void bodies_in_pages(List& list) {
    typename List::Page all;
    reader_.read_array(all.states, kMaxRecords);
    reader_.read_array(all.properties, kMaxRecords);
    bool good = all.states.size() == all.properties.size();
    for (std::size_t i = 0; good && i < all.states.size(); ++i)
      good = all.states[i].slot < kMaxRecords && (i == 0 || all.states[i - 1].slot < all.states[i].slot);
    if (!good) reader_.fail(ErrorCode::corrupt, "static bodies ascend by slot, each with its properties");
    for (std::size_t i = 0; i < all.states.size() && reader_.ok(); ++i) list.insert(all.states[i], all.properties[i]);
  }
  template <class Island, std::uint32_t kPageSize>
  ISO_INLINE void islands(const char*, PagedArray<std::shared_ptr<const Island>, kPageSize>& list) {
    const std::uint32_t count = reader_.read_count(kMaxRecords, Island::kLeastWritten);
    for (std::uint32_t i = 0; i < count && reader_.ok(); ++i) {
      auto island = std::make_shared<Island>();
      Island::sections(*this, *island);
      island->hash = hash_sections(*island);
      list.push_back(std::move(island));
    }
  }
  template <class Records, class Parts> ISO_INLINE void records(Shared<Records>& value, Parts& parts) {
    const auto kinds = reader_.read<std::uint32_t>();
    if (kinds >> Records::kKinds != 0) reader_.fail(ErrorCode::invalid, "records of unknown kinds");
    if (reader_.ok() && kinds != 0) Records::members_of(kinds, *this, value.change(), parts);
  }
  template <class Store> ISO_INLINE void store(const char*, Shared<Store>& value) { read_store_(value.change()); }

 private:
  Reader& reader_;
  ReadStore read_store_;
};

}  // namespace isostep::detail
