// XXH3 behind our own names: compiled in here, so that no other file of a program can bring another version of it.
// SPDX-License-Identifier: MIT
#include "isostep/state/hash.hpp"

#include <new>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace isostep {
namespace {

XXH3_state_t* as_xxh3(std::uint8_t* storage) { return std::launder(reinterpret_cast<XXH3_state_t*>(storage)); }
const XXH3_state_t* as_xxh3(const std::uint8_t* storage) {
  return std::launder(reinterpret_cast<const XXH3_state_t*>(storage));
}

}  // namespace

static_assert(sizeof(XXH3_state_t) <= sizeof(HashStream) && alignof(XXH3_state_t) <= alignof(HashStream));

std::uint64_t hash_bytes(const void* bytes, std::size_t size) { return XXH3_64bits(bytes, size); }

ContentId content_id_of(Bytes tag, Bytes content) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  XXH3_128bits_update(&state, tag.data(), tag.size());
  XXH3_128bits_update(&state, content.data(), content.size());
  const XXH128_hash_t id = XXH3_128bits_digest(&state);
  return {id.low64, id.high64};
}

HashStream::HashStream() {
  new (state_) XXH3_state_t;
  XXH3_64bits_reset(as_xxh3(state_));
}

void HashStream::update(const void* bytes, std::size_t size) { XXH3_64bits_update(as_xxh3(state_), bytes, size); }

std::uint64_t HashStream::value() const { return XXH3_64bits_digest(as_xxh3(state_)); }

}  // namespace isostep
