// Blobs and how they are written.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/blob.hpp"

#include <utility>

namespace isostep {
namespace {

ContentId id_of(ShapeType type, Bytes bytes) {
  std::uint8_t tag[4];
  store_le(tag, static_cast<std::uint32_t>(type));
  return content_id_of(tag, bytes);
}

}  // namespace

Blob::Blob(ShapeType type, std::vector<std::uint8_t> bytes, BlobHome home)
    : id_(id_of(type, bytes)), type_(type), home_(home), bytes_(std::move(bytes)) {}

BlobRef Blob::make(ShapeType type, std::vector<std::uint8_t> bytes, BlobHome home) {
  return BlobRef(new Blob(type, std::move(bytes), home));
}

Blob::~Blob() {
  for (const Made* made = made_.load(); made != nullptr;) {
    const Made* next = made->next;
    delete made;
    made = next;
  }
}

/// Two threads that ask at once may both make the content; the two are alike, and both are kept.
const void* Blob::content(ContentMaker maker) const {
  for (const Made* made = made_.load(std::memory_order_acquire); made != nullptr; made = made->next) {
    if (made->maker == maker) return made->content.get();
  }
  Made* made = new Made{maker, maker(*this), made_.load(std::memory_order_relaxed)};
  while (!made_.compare_exchange_weak(made->next, made, std::memory_order_release, std::memory_order_relaxed)) {}
  return made->content.get();
}

void Blob::write(Writer& writer) const {
  writer.write(type_);
  writer.write_bytes(bytes_);
}

BlobRef Blob::read(Reader& reader, const ContentId& id) {
  const auto type = reader.read<ShapeType>();
  const Bytes bytes = reader.read_bytes(kMaxBlobBytes);
  if (!reader.ok()) return nullptr;
  if (!(id_of(type, bytes) == id)) {
    reader.fail(ErrorCode::corrupt, "a blob's name is not the hash of its content");
    return nullptr;
  }
  return make(type, {bytes.begin(), bytes.end()});
}

void write_carried(Writer& writer, const BlobRef& blob) {
  const bool carried = blob != nullptr && blob->home() == BlobHome::carried;
  writer.write(carried);
  if (carried) blob->write(writer);
}

BlobRef read_carried(Reader& reader, const ContentId& id) {
  return reader.read<bool>() ? Blob::read(reader, id) : nullptr;
}

void BlobMention::write(Writer& writer) const {
  writer.write(id);
  write_carried(writer, content);
}

void BlobMention::read(Reader& reader) {
  reader.read(id);
  content = read_carried(reader, id);
}

}  // namespace isostep
