// The name of every way in which a shape can fail.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

enum class ShapeFault : std::uint32_t {
  none,
  no_children,           // an empty list
  unknown_type,          // a number that names no shape
  not_finite,            // NaN or infinity anywhere
  unused_field_set,      // a field that the type has no use for is not zero, so equal shapes would not hash alike
  size_not_positive,     // a radius, half extent or half height of zero or less
  size_too_small,        // below Limits<S>::minimum_size()
  size_too_large,        // above Limits<S>::extent()
  offset_too_large,      // a half-space further from the body's origin than Limits<S>::position()
  normal_not_unit,       // squared length off one by more than 1/64
  orientation_not_unit,  // likewise
  blob_missing,          // a shape that has one names no blob, or one of another type
  blob_not_valid,        // its bytes are not what the type's are
  outside_extent,        // a child reaches further from the body's origin than Limits<S>::extent(), along some axis
  too_many_triangles,    // of all children together 2^31 or more
  radius_not_in_range    // of a hull, whose radius may be 0: below that, or above Limits<S>::extent()
};

/// The fault in words, for messages.
ISO_INLINE constexpr const char* describe(ShapeFault fault) {
  switch (fault) {
    case ShapeFault::none: return "no fault";
    case ShapeFault::no_children: return "a shape has no children";
    case ShapeFault::unknown_type: return "the type names no shape";
    case ShapeFault::not_finite: return "a number is not finite";
    case ShapeFault::unused_field_set: return "a field that the type does not use is not zero";
    case ShapeFault::size_not_positive: return "a radius, half extent or half height is not positive";
    case ShapeFault::size_too_small: return "a size is below the scalar's smallest";
    case ShapeFault::size_too_large: return "a size is above the scalar's largest extent";
    case ShapeFault::offset_too_large: return "a half-space's offset is above the scalar's largest position";
    case ShapeFault::normal_not_unit: return "a normal is not of unit length";
    case ShapeFault::orientation_not_unit: return "an orientation is not of unit length";
    case ShapeFault::blob_missing: return "a shape names no blob of its type";
    case ShapeFault::blob_not_valid: return "a blob's bytes make no shape of its type";
    case ShapeFault::outside_extent: return "a child reaches beyond the scalar's largest extent";
    case ShapeFault::too_many_triangles: return "a shape has 2^31 triangles or more";
    case ShapeFault::radius_not_in_range: return "a hull's radius is below 0 or above the scalar's largest extent";
  }
  return "unknown fault";
}

/// The value that the faulty field should have.
ISO_INLINE constexpr const char* expected_of(ShapeFault fault) {
  switch (fault) {
    case ShapeFault::none: break;
    case ShapeFault::no_children: return "one or more";
    case ShapeFault::unknown_type: return "one of ShapeType";
    case ShapeFault::not_finite: return "a finite number";
    case ShapeFault::unused_field_set: return "0: the type does not use it";
    case ShapeFault::size_not_positive: return "above 0";
    case ShapeFault::size_too_small: return "Limits::minimum_size() or more";
    case ShapeFault::size_too_large: return "up to Limits::extent()";
    case ShapeFault::offset_too_large: return "up to Limits::position()";
    case ShapeFault::normal_not_unit: return "a vector of length 1";
    case ShapeFault::orientation_not_unit: return "a quaternion of length 1";
    case ShapeFault::blob_missing: return "a blob of the type";
    case ShapeFault::blob_not_valid: return "bytes that make a shape of the type";
    case ShapeFault::outside_extent: return "all of the child up to Limits::extent() from the body's origin";
    case ShapeFault::too_many_triangles: return "fewer than 2^31 triangles";
    case ShapeFault::radius_not_in_range: return "0 to Limits::extent()";
  }
  return "";
}

/// The fault of a shape, and the part and the field that have it.
struct ShapeFaultPlace {
  ShapeFault fault = ShapeFault::none;
  std::uint32_t child = 0;
  const char* field = "";  // of Child: primitive.radius
};

}  // namespace isostep
