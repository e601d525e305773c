// Blobs to files and back.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/blob_file.hpp"

#include <cstring>

namespace isostep {

std::vector<std::uint8_t> blob_file(const Blob& blob) {
  std::vector<std::uint8_t> file;
  Writer writer(file);
  writer.write_raw(kBlobFileMagic);
  writer.write(blob.id());
  blob.write(writer);
  return file;
}

Result<BlobRef> read_blob_file(Bytes file, BlobHome home) {
  if (file.size() < sizeof kBlobFileMagic || std::memcmp(file.data(), kBlobFileMagic, sizeof kBlobFileMagic) != 0)
    return Error{ErrorCode::invalid, "the file does not begin as a baked blob does", "byte 0"};
  Reader reader(file.subspan(sizeof kBlobFileMagic));
  const auto id = reader.read<ContentId>();
  const BlobRef blob = Blob::read(reader, id);
  reader.expect_end();
  const Result<void> whole = reader.result("blob");
  if (!whole) return whole.error();
  if (static_cast<std::uint32_t>(blob->type()) >= std::uint32_t{kShapeTypes})
    return Error{ErrorCode::invalid, "no shape has the type of this blob", "type"};
  if (home == blob->home()) return blob;
  return Blob::make(blob->type(), {blob->bytes().begin(), blob->bytes().end()}, home);
}

}  // namespace isostep
