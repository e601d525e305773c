// Body of closest_point.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"

namespace isostep {

template <class S>
ClosestPoint<S> closest_point(const Primitive<S>& primitive, const Transform<S>& transform, Vec3<S> query) {
  return visit_shape(primitive, [&](const auto& shape) { return shape.closest(transform, query); });
}

}  // namespace isostep
