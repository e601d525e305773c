// ShapeView: a stored shape with the content of its blob.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/primitive.hpp"

namespace isostep {

/// The view that functions of shapes take. A Primitive without a blob is one by itself; one with a blob that comes
/// without its content must not be asked for its geometry.
template <class S> struct ShapeView {
  const Primitive<S>& primitive;
  const void* content;  // a Shape<S>::Content, see shape.hpp; null for shapes without a blob

  ISO_INLINE constexpr ShapeView(const Primitive<S>& stored, const void* content_of_blob = nullptr)
      : primitive(stored), content(content_of_blob) {}
};

/// The content of blobs in a scalar by their places, as Primitive::blob counts them.
template <class S> struct Contents {
  const void* const* by_place = nullptr;

  ISO_INLINE constexpr ShapeView<S> view(const Primitive<S>& primitive) const {
    return {primitive, primitive.blob == 0 ? nullptr : by_place[primitive.blob - 1]};
  }
};

}  // namespace isostep
