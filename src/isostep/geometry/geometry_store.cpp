// The geometry store.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/geometry_store.hpp"

namespace isostep {

std::uint32_t GeometryStore::find(const ContentId& id) const {
  for (std::uint32_t place = 0; place < names_.size(); ++place) {
    if (names_[place].uses != 0 && names_[place].id == id) return place;
  }
  return kNone;
}

BlobRef GeometryStore::find(const BlobMention& mention, const AssetSource& assets) const {
  const std::uint32_t place = find(mention.id);
  BlobRef blob = place != kNone ? contents_[place] : mention.content != nullptr ? mention.content : assets(mention.id);
  return blob != nullptr && blob->id() == mention.id ? blob : nullptr;
}

std::uint32_t GeometryStore::take(const BlobRef& blob) {
  const std::uint32_t known = find(blob->id());
  if (known != kNone) {
    ++names_[known].uses;
    return known;
  }
  std::uint32_t place = 0;
  while (is_taken(place)) ++place;
  if (place == names_.size()) {
    names_.emplace_back();
    contents_.emplace_back();
  }
  names_[place] = {blob->id(), 1};
  contents_[place] = blob;
  return place;
}

void GeometryStore::give_back(std::uint32_t place) {
  if (--names_[place].uses != 0) return;
  names_[place] = {};
  contents_[place] = nullptr;
  while (!names_.empty() && names_.back().uses == 0) {
    names_.pop_back();
    contents_.pop_back();
  }
}

void GeometryStore::write(Writer& writer) const {
  writer.write_array(names_);
  for (std::uint32_t place = 0; place < names_.size(); ++place) {
    if (!is_taken(place)) continue;
    write_carried(writer, contents_[place]);
  }
}

void GeometryStore::read(Reader& reader, const GeometryStore& known, const AssetSource& assets) {
  reader.read_array(names_, kMaxBlobs);
  contents_.assign(names_.size(), nullptr);
  for (std::uint32_t place = 0; place < names_.size() && reader.ok(); ++place) {
    if (!is_taken(place)) continue;
    const ContentId id = names_[place].id;
    const BlobRef carried = read_carried(reader, id);
    if (!reader.ok()) return;
    contents_[place] = known.find(BlobMention{id, carried}, assets);
    if (contents_[place] == nullptr)
      reader.fail(ErrorCode::incompatible, "it names a blob that neither it nor the game's assets have");
  }
}

}  // namespace isostep
