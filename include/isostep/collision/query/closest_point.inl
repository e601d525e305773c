// Body of closest_point.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/geometry/baked/polyhedron_surface.inl"

namespace isostep {

template <class S>
ClosestPoint<S> closest_point(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> query) {
  return visit_shape(shape, [&](const auto& visited) { return visited.closest(transform, query); });
}

}  // namespace isostep
