// GeometryStore: the blobs that a state's shapes name.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/geometry/blob.hpp"

namespace isostep {

inline constexpr std::uint32_t kMaxBlobs = 1u << 16;  // of one store: names are searched one by one

/// A blob's name, and the number of parts of shapes that name it. All is 0 where unused.
struct BlobName {
  ContentId id;
  std::uint64_t uses;

  ISO_FIELDS(id, uses)
};
static_assert(kHasNoPadding<BlobName>);

/// The names are state; the content stands outside it, shared by reference count: a blob that a world, a snapshot or a
/// recorded command still names is kept. Parts of shapes name a blob by its place here, which follows from the commands
/// alone: the lowest that is free.
class GeometryStore {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  ISO_INLINE bool empty() const { return names_.empty(); }
  ISO_INLINE const std::vector<BlobName>& names() const { return names_; }
  ISO_INLINE bool is_taken(std::uint32_t place) const { return place < names_.size() && names_[place].uses != 0; }
  /// Returns the content of a place that is taken.
  ISO_INLINE const BlobRef& content(std::uint32_t place) const { return contents_[place]; }
  /// Returns all contents by place; null where none is taken.
  ISO_INLINE std::span<const BlobRef> contents() const { return contents_; }
  /// Returns the place of a blob, or kNone if the store does not have it.
  std::uint32_t find(const ContentId& id) const;
  /// Returns the blob of that name: the store's own (so that each content is in memory once and an asset stays one), or
  /// the carried one, or the asset. Null if none of them has it.
  BlobRef find(const BlobMention& mention, const AssetSource& assets) const;

  /// Adds a use of a blob and returns its place.
  std::uint32_t take(const BlobRef& blob);
  /// Removes a use; a blob without any leaves the store.
  void give_back(std::uint32_t place);

  /// Writes the names, and for each the content that is carried.
  void write(Writer& writer) const;
  /// Reads names and contents. Content that the file does not carry comes from `known`, another store, or from the
  /// assets. Content that no one has is ErrorCode::incompatible.
  void read(Reader& reader, const GeometryStore& known, const AssetSource& assets);

 private:
  std::vector<BlobName> names_;    // the last one is taken
  std::vector<BlobRef> contents_;  // of each name
};

}  // namespace isostep
