// The content of blobs in a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/blob.hpp"

namespace isostep {

/// The content that ShapeView names: the Content of the blob's shape in S, made when it is first asked for. Null for a
/// type without blobs.
template <class S> const void* content_of(const Blob& blob);

/// Finds the contents of many blobs, for Contents; null where a blob is null.
template <class S> void find_contents(std::span<const BlobRef> blobs, std::vector<const void*>& out) {
  out.resize(blobs.size());
  for (std::size_t i = 0; i < blobs.size(); ++i) out[i] = blobs[i] == nullptr ? nullptr : content_of<S>(*blobs[i]);
}

#define ISO_CONTENT_OF(extern, S)                         \
  extern template const void* content_of<S>(const Blob&); \
  extern template void find_contents<S>(std::span<const BlobRef>, std::vector<const void*>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CONTENT_OF)

}  // namespace isostep
