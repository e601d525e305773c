// Blob: the content of a shape that is too large for a record: a hull's faces, a level's triangles.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "isostep/geometry/shape_type.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/hash.hpp"

namespace isostep {

inline constexpr std::uint32_t kMaxBlobBytes = 1u << 28;  // of one blob in a file

/// The place where readers of a state or a recording find a blob that it names.
enum class BlobHome : std::uint8_t {
  carried,  // in it
  asset     // with the game, which brings it: a level's mesh in a replay of ten seconds
};

class Blob;
using BlobRef = std::shared_ptr<const Blob>;

/// Makes a shape's content from a blob's bytes, whatever they are: their fault is content too. There is one function
/// for each scalar.
using ContentMaker = std::shared_ptr<const void> (*)(const Blob&);

/// An immutable content, shared by all that name it: worlds, snapshots, commands. Its name is the hash of its type and
/// its bytes, so equal content has one name on every machine. The bytes are little-endian integers; the shape's file
/// says what they mean.
class Blob {
 public:
  static BlobRef make(ShapeType type, std::vector<std::uint8_t> bytes, BlobHome home = BlobHome::carried);

  ISO_INLINE ContentId id() const { return id_; }
  ISO_INLINE ShapeType type() const { return type_; }
  ISO_INLINE BlobHome home() const { return home_; }
  ISO_INLINE Bytes bytes() const { return bytes_; }
  /// The content that `make` makes of it: when it is first asked for, from any thread, and kept as long as the blob.
  const void* content(ContentMaker make) const;

  Blob(const Blob&) = delete;
  Blob& operator=(const Blob&) = delete;
  ~Blob();

  void write(Writer& writer) const;
  /// Reads what `write` wrote of a blob with that name. Returns null, and fails the reader, for anything else.
  static BlobRef read(Reader& reader, const ContentId& id);

 private:
  struct Made {
    ContentMaker maker;
    std::shared_ptr<const void> content;
    const Made* next;
  };

  Blob(ShapeType type, std::vector<std::uint8_t> bytes, BlobHome home);

  ContentId id_;
  ShapeType type_;
  BlobHome home_;
  std::vector<std::uint8_t> bytes_;
  mutable std::atomic<const Made*> made_ = nullptr;  // a list that only grows
};

/// Writes whether a blob is carried, and its content if so; null is not carried.
void write_carried(Writer& writer, const BlobRef& blob);
/// Reads what write_carried wrote. Returns null when the blob is not carried, or the reader has failed.
BlobRef read_carried(Reader& reader, const ContentId& id);

/// The game's blobs by their names: called while a state is read or a command executed, returns null for a name that it
/// does not know.
struct AssetSource {
  BlobRef (*find)(void* user, const ContentId& id) = nullptr;
  void* user = nullptr;

  ISO_INLINE BlobRef operator()(const ContentId& id) const { return find == nullptr ? nullptr : find(user, id); }
};

/// A blob as a command names it: with its content, or by its name alone where the world or its assets have it.
struct BlobMention {
  ContentId id;
  BlobRef content;  // or null

  // These are what the compiler would make, but without weak functions in each of the files that hold commands.
  ISO_INLINE BlobMention() = default;
  ISO_INLINE BlobMention(const ContentId& name, BlobRef blob) : id(name), content(std::move(blob)) {}
  ISO_INLINE BlobMention(const BlobMention&) = default;
  ISO_INLINE BlobMention(BlobMention&&) = default;
  ISO_INLINE BlobMention& operator=(const BlobMention&) = default;
  ISO_INLINE BlobMention& operator=(BlobMention&&) = default;

  void write(Writer& writer) const;
  void read(Reader& reader);
};

}  // namespace isostep
