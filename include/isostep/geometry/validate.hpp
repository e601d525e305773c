// What a shape must satisfy before a world takes it.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/geometry/shape_fault.hpp"

namespace isostep {

/// Returns the first fault found, in a fixed order of checks.
template <class S> ShapeFault validate(const Primitive<S>& primitive);
template <class S> ShapeFault validate(const Pose<S>& pose);
/// Returns it for children whose blobs are `blobs`, as Primitive::blob counts them.
template <class S> ShapeFault validate(std::span<const Child<S>> children, std::span<const BlobRef> blobs = {});
/// Returns that fault and its place.
template <class S> ShapeFaultPlace find_fault(std::span<const Child<S>> children, std::span<const BlobRef> blobs = {});

/// Returns a valid child with its normal and orientation scaled to unit length, and its traits zeroed where no flag
/// names them. What is so already stays bit for bit.
template <class S> Child<S> normalised(const Child<S>& child);

#define ISO_VALIDATE_OF(extern, S)                                                                    \
  extern template ShapeFault validate<S>(const Primitive<S>&);                                        \
  extern template ShapeFault validate<S>(const Pose<S>&);                                             \
  extern template ShapeFault validate<S>(std::span<const Child<S>>, std::span<const BlobRef>);        \
  extern template ShapeFaultPlace find_fault<S>(std::span<const Child<S>>, std::span<const BlobRef>); \
  extern template Child<S> normalised<S>(const Child<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_VALIDATE_OF)

}  // namespace isostep
