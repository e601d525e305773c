// Slot tables as state: hashed, written and read like the records they number.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/slot_map.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/hash.hpp"

namespace isostep::detail {

inline constexpr std::uint32_t kMaxRecords = 1u << 24;  // of any kind in a file; more is a damaged count

/// Hashes the start of the free list, and the entries page by page, so that a slot taken or given back costs its page.
ISO_INLINE std::uint64_t hash_slots(const SlotMap& slot_map) {
  return slot_map.remembered_hash().get([&]() ISO_INLINE_LAMBDA {
    const SlotMap::Entries& entries = slot_map.entries();
    HashCombiner combiner;
    combiner.add(slot_map.first_free());
    for (std::size_t p = 0; p < entries.pages(); ++p) {
      combiner.add(entries.remembered(p).get(
          [&]() ISO_INLINE_LAMBDA { return hash_records(entries.page(p), entries.page_size(p)); }));
    }
    return combiner.value();
  });
}
ISO_INLINE void write_slots(Writer& writer, const SlotMap& slot_map) {
  const SlotMap::Entries& entries = slot_map.entries();
  writer.write(slot_map.first_free());
  writer.write_count(entries.size());
  for (std::size_t p = 0; p < entries.pages(); ++p) writer.write_records(entries.page(p), entries.page_size(p));
}
ISO_INLINE void read_slots(Reader& reader, SlotMap& slot_map) {
  const auto first_free = reader.read<std::uint32_t>();
  std::vector<SlotEntry> entries;
  reader.read_array(entries, kMaxRecords);
  if (reader.ok() && !slot_map.restore(entries, first_free))
    reader.fail(ErrorCode::corrupt, "a slot table's free list is broken");
}

}  // namespace isostep::detail
