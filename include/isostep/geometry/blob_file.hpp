// A blob as a file of its own: geometry that is baked once, by `isostep bake` or by a game, and loaded as it is.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/geometry/blob.hpp"

namespace isostep {

/// The first bytes of such a file. The high bit and both line ends are there so that a transfer as text shows at once.
inline constexpr std::uint8_t kBlobFileMagic[8] = {0x89, 'I', 'S', 'B', '\r', '\n', 0x1a, '\n'};

/// The file: the magic; then, little-endian, the blob's name, two u64, the low one first; its type, u32; the number of
/// its bytes, u32; its bytes. The name covers type and bytes.
std::vector<std::uint8_t> blob_file(const Blob& blob);

/// Reads the blob of such a file, from bytes nobody vouches for. `validate` and worlds tell whether they make a shape.
/// Errors: ErrorCode::invalid for what does not begin with the magic, and for a type that no shape has;
/// ErrorCode::truncated; ErrorCode::corrupt where name and content differ, or bytes follow; ErrorCode::limit for more
/// than kMaxBlobBytes.
Result<BlobRef> read_blob_file(Bytes file, BlobHome home = BlobHome::carried);

}  // namespace isostep
