// Baked files of scenes, read.
// SPDX-License-Identifier: MIT
#include "blob_files.hpp"

#include <fstream>
#include <system_error>
#include <vector>

#include "isostep/geometry/blob_file.hpp"

namespace isostep::scenes {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytes_of(const fs::path& path, const std::string& name, const std::string& place) {
  constexpr std::uintmax_t kMost = kMaxBlobBytes + 4096u;  // with what stands before a blob
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw SceneError(place, name + ": " + error.message());
  if (size > kMost) throw SceneError(place, name + ": expected a baked blob, found " + std::to_string(size) + " bytes");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw SceneError(place, name + ": cannot be read");
  return bytes;
}

}  // namespace

bool has_blob(ShapeType type) {
  return visit_shape_type(type, [](auto tag) { return decltype(tag)::template Of<double>::kHasBlob; });
}

BlobRef BlobFiles::read(const std::string& name, ShapeType type, const std::string& place) {
  BlobRef& blob = read_[name];
  if (blob == nullptr) {
    const Result<BlobRef> read = read_blob_file(bytes_of(folder_ / name, name, place));
    if (!read.ok())
      throw SceneError(
          place, name + ": expected a blob that `isostep bake` wrote: " + std::string(read.error().message.view()));
    blob = read.value();
  }
  if (blob->type() == type) return blob;
  const auto name_of = [](ShapeType of) { return std::string(kShapeNames[static_cast<std::size_t>(of)]); };
  throw SceneError(place, name + ": expected a baked " + name_of(type) + ", found a " + name_of(blob->type()));
}

}  // namespace isostep::scenes
