// Bodies of content.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/hull_content.inl"
#include "isostep/geometry/baked/surface_queries.inl"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

namespace detail {
template <class S> std::shared_ptr<const void> make_content(const Blob& blob) {
  return visit_shape_type(blob.type(), [&](auto tag) -> std::shared_ptr<const void> {
    using Shape = typename decltype(tag)::template Of<S>;
    if constexpr (Shape::kHasBlob) return Shape::Content::make(blob.bytes());
    else return nullptr;
  });
}
}  // namespace detail

template <class S> const void* content_of(const Blob& blob) {
  const bool exists = static_cast<std::uint32_t>(blob.type()) < kShapeTypes;
  return exists ? blob.content(&detail::make_content<S>) : nullptr;
}

}  // namespace isostep
