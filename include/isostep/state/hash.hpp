// The state hash: XXH3-64 over canonical bytes, and what makes one hash of many.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "isostep/core/bytes.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/state/pack.hpp"

namespace isostep {

/// The name of the algorithm in files.
inline constexpr char kHashName[] = "xxh3-64";

/// XXH3-64 with seed 0. The result depends on the bytes alone, not on the instruction set.
std::uint64_t hash_bytes(const void* bytes, std::size_t size);

/// The name of content: its XXH3-128. Two different contents never share one by chance.
struct ContentId {
  std::uint64_t low = 0, high = 0;

  friend ISO_INLINE constexpr bool operator==(const ContentId& a, const ContentId& b) {
    return a.low == b.low && a.high == b.high;
  }
  ISO_FIELDS(low, high)
};
/// Returns the id of the tag's bytes followed by the content's.
ContentId content_id_of(Bytes tag, Bytes content);

/// Hashes bytes that arrive in pieces, with the result that hash_bytes has for all at once.
class HashStream {
 public:
  HashStream();
  void update(const void* bytes, std::size_t size);
  /// Returns the hash of everything so far; more may follow.
  std::uint64_t value() const;

 private:
  alignas(64) std::uint8_t state_[576];  // an XXH3_state_t, whose header stays out of ours
};

/// Makes one hash of all added words, in the order in which they are added. It is no sum and no exclusive or, so two
/// subsystems that swap their hashes change it, and two equal hashes do not cancel.
class HashCombiner {
 public:
  ISO_INLINE HashCombiner() : hash_(0) {}
  ISO_INLINE void add(std::uint64_t word) {
    std::uint8_t link[16];
    store_le(link, hash_);
    store_le(link + 8, word);
    hash_ = hash_bytes(link, sizeof link);
  }
  ISO_INLINE std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_;
};

/// Hashes n records by their fields: correct on every machine, for records with or without padding.
template <class T> ISO_INLINE std::uint64_t hash_records_by_fields(const T* first, std::size_t n) {
  HashStream stream;
  std::uint8_t bytes[kPackedSize<T> + 1];
  for (std::size_t i = 0; i < n; ++i) {
    pack(bytes, first[i]);
    stream.update(bytes, kPackedSize<T>);
  }
  return stream.value();
}

/// Hashes records as hash_records_by_fields does, at the speed of memory if their bytes there are canonical.
template <class T> ISO_INLINE std::uint64_t hash_records(const T* first, std::size_t n) {
  static_assert(kHasNoPadding<T>, "padding has no value, so it can have no hash");
  if constexpr (std::endian::native == std::endian::little) {
    return hash_bytes(first, n * sizeof(T));
  } else {
    return hash_records_by_fields(first, n);
  }
}

/// Adds n records to a stream: pieces one after another give the hash of the whole array.
template <class T> ISO_INLINE void update_records(HashStream& stream, const T* first, std::size_t n) {
  static_assert(kHasNoPadding<T>, "padding has no value, so it can have no hash");
  if constexpr (std::endian::native == std::endian::little) {
    stream.update(first, n * sizeof(T));
  } else {
    std::uint8_t bytes[kPackedSize<T> + 1];
    for (std::size_t i = 0; i < n; ++i) {
      pack(bytes, first[i]);
      stream.update(bytes, kPackedSize<T>);
    }
  }
}

}  // namespace isostep
