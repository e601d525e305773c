// Registry: records that come and go by id, in an array by slot; copies share the array until one of them changes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/shared.hpp"
#include "isostep/core/slot_map.hpp"

namespace isostep {

/// A free slot holds Record{}, whose meaning is that nothing is there.
template <class Record, class IdType> class Registry {
 public:
  ISO_INLINE Registry() = default;
  ISO_INLINE Registry(const Registry&) = default;
  ISO_INLINE Registry(Registry&&) = default;
  ISO_INLINE Registry& operator=(const Registry&) = default;
  ISO_INLINE Registry& operator=(Registry&&) = default;
  /// Adds a record. `space` is the world's id space: see SlotMap.
  ISO_INLINE IdType add(const Record& record, std::uint32_t space = 0) {
    const IdType id = slots_.template take<IdType>(space);
    std::vector<Record>& all = records_.change();
    if (id.slot < all.size()) all[id.slot] = record;
    else all.push_back(record);
    return id;
  }
  ISO_INLINE bool remove(IdType id) {
    if (!slots_.holds(id)) return false;
    remove_at(id.slot);
    return true;
  }
  /// Removes the record of a slot that is taken.
  ISO_INLINE void remove_at(std::uint32_t slot) {
    records_.change()[slot] = Record{};
    slots_.give_back(slot);
  }
  ISO_INLINE bool holds(IdType id) const { return slots_.holds(id); }
  /// Returns null for a stale id.
  ISO_INLINE const Record* find(IdType id) const { return slots_.holds(id) ? &(*records_)[id.slot] : nullptr; }
  /// Returns the id of the first record, by slot, that matches; null if none does.
  template <class Match> ISO_INLINE IdType id_where(const Match& match) const {
    for (std::uint32_t slot = 0; slot < records_->size(); ++slot) {
      if (slots_.is_taken(slot) && match((*records_)[slot])) return slots_.template id_of<IdType>(slot);
    }
    return {};
  }
  /// Returns the record of an id that is held, to be written.
  ISO_INLINE Record& change(IdType id) { return records_.change()[id.slot]; }

  ISO_INLINE const SlotMap& slot_map() const { return slots_; }
  ISO_INLINE SlotMap& slot_map() { return slots_; }
  /// Returns all records by slot, free slots included.
  ISO_INLINE const std::vector<Record>& all() const { return *records_; }
  ISO_INLINE std::vector<Record>& change_all() { return records_.change(); }
  ISO_INLINE const Remembered& remembered() const { return records_.remembered(); }
  ISO_INLINE bool is_taken(std::uint32_t slot) const { return slots_.is_taken(slot); }

 private:
  SlotMap slots_;
  Shared<std::vector<Record>> records_;
};

}  // namespace isostep
