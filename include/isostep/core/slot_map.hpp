// SlotMap: hands out slots and generations. Its free list is state: the next id is part of a world's future.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/core/paged_array.hpp"

namespace isostep {

struct SlotEntry {
  std::uint32_t generation;  // of the present tenant, or of the next
  std::uint32_t next_free;   // kTaken, kRetired, or the slot freed before this one

  static constexpr std::uint32_t kTaken = 0xffffffffu;
  static constexpr std::uint32_t kEnd = 0xfffffffeu;
  static constexpr std::uint32_t kRetired = 0xfffffffdu;  // it has had as many tenants as can be told apart

  ISO_FIELDS(generation, next_free)
};
static_assert(kHasNoPadding<SlotEntry>);

/// A generation's upper byte is its world's id space, the rest counts the slot's tenants: so that an id of a world with
/// another space names nothing here. After 2^24 - 1 tenants a slot is used no more, so that no id comes back.
/// Copies share the table's pages: a copy costs what was taken or given back since the last.
class SlotMap {
 public:
  static constexpr std::uint32_t kPageSize = 512;
  using Entries = PagedArray<SlotEntry, kPageSize>;

  // These are written out: functions that a compiler writes itself are symbols that two object files may share.
  ISO_INLINE SlotMap() : first_free_(SlotEntry::kEnd) {}
  ISO_INLINE SlotMap(const SlotMap& other)
      : hash_(other.hash_), entries_(other.entries_), first_free_(other.first_free_) {}
  ISO_INLINE ~SlotMap() {}
  ISO_INLINE SlotMap& operator=(const SlotMap& other) {
    hash_ = other.hash_;
    entries_ = other.entries_;
    first_free_ = other.first_free_;
    return *this;
  }

  static constexpr std::uint32_t kIdSpaces = 256;
  template <class AnyId> static ISO_INLINE std::uint32_t space_of(AnyId id) { return id.generation >> kSpaceShift; }

  template <class AnyId> ISO_INLINE AnyId take(std::uint32_t space = 0) {
    hash_.forget();
    if (first_free_ == SlotEntry::kEnd) {
      const std::uint32_t generation = space << kSpaceShift | 1u;
      entries_.push_back({generation, SlotEntry::kTaken});
      return {static_cast<std::uint32_t>(entries_.size() - 1), generation};
    }
    const std::uint32_t slot = first_free_;
    SlotEntry& entry = entries_.change(slot);
    first_free_ = entry.next_free;
    entry.next_free = SlotEntry::kTaken;
    return {slot, entry.generation};
  }
  ISO_INLINE void give_back(std::uint32_t slot) {
    hash_.forget();
    SlotEntry& entry = entries_.change(slot);
    if ((entry.generation & kTenants) == kTenants) {
      entry.next_free = SlotEntry::kRetired;
      return;
    }
    ++entry.generation;
    entry.next_free = first_free_;
    first_free_ = slot;
  }
  template <class AnyId> ISO_INLINE bool holds(AnyId id) const {
    return id.slot < entries_.size() && is_taken(id.slot) && entries_[id.slot].generation == id.generation;
  }
  ISO_INLINE bool is_taken(std::uint32_t slot) const { return entries_[slot].next_free == SlotEntry::kTaken; }
  template <class AnyId> ISO_INLINE AnyId id_of(std::uint32_t slot) const { return {slot, entries_[slot].generation}; }

  /// Returns the ids of all taken slots, ascending by slot.
  template <class AnyId> ISO_INLINE std::vector<AnyId> ids() const {
    std::vector<AnyId> ids;
    for (std::uint32_t slot = 0; slot < entries_.size(); ++slot) {
      if (is_taken(slot)) ids.push_back(id_of<AnyId>(slot));
    }
    return ids;
  }
  ISO_INLINE std::uint32_t count_taken() const {
    std::uint32_t count = 0;
    for (std::uint32_t slot = 0; slot < entries_.size(); ++slot) count += is_taken(slot) ? 1u : 0u;
    return count;
  }

  ISO_INLINE const Entries& entries() const { return entries_; }
  ISO_INLINE std::uint32_t first_free() const { return first_free_; }
  /// Returns the hash computed from the whole table.
  ISO_INLINE const Remembered& remembered_hash() const { return hash_; }
  /// Takes the entries of a file. Returns false if the free list is not one list of exactly the free slots.
  ISO_INLINE bool restore(const std::vector<SlotEntry>& entries, std::uint32_t first_free) {
    std::size_t free = 0, met = 0;
    for (const SlotEntry& entry : entries) {
      if (entry.generation == 0) return false;
      if (entry.next_free == SlotEntry::kRetired && (entry.generation & kTenants) != kTenants) return false;
      free += is_free(entry);
    }
    for (std::uint32_t slot = first_free; slot != SlotEntry::kEnd; slot = entries[slot].next_free) {
      if (slot >= entries.size() || !is_free(entries[slot]) || ++met > free) return false;
    }
    if (met != free) return false;
    hash_.forget();
    entries_.clear();
    for (const SlotEntry& entry : entries) entries_.push_back(entry);
    first_free_ = first_free;
    return true;
  }

 private:
  static constexpr int kSpaceShift = 24;
  static constexpr std::uint32_t kTenants = (1u << kSpaceShift) - 1u;

  static ISO_INLINE bool is_free(const SlotEntry& entry) {
    return entry.next_free != SlotEntry::kTaken && entry.next_free != SlotEntry::kRetired;
  }

  Remembered hash_;
  Entries entries_;
  std::uint32_t first_free_;
};

}  // namespace isostep
