// The tight world boxes of primitives and of lists of children.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <type_traits>

#include "isostep/geometry/shape.hpp"

namespace isostep {

/// The smallest box around a primitive, world frame.
/// Error: each side within one resolution step of the exact one, inwards or outwards; the broad phase adds a margin.
///        A half-space's is cut by the cube of twice the position limit.
template <class S>
ISO_INLINE constexpr Aabb<S> bounds(const std::type_identity_t<ShapeView<S>>& shape, const Transform<S>& t) {
  return visit_shape(shape, [&](const auto& visited) ISO_INLINE_LAMBDA { return visited.bounds(t); });
}

template <class S> ISO_INLINE constexpr Aabb<S> bounds(const Primitive<S>& primitive, const Transform<S>& t) {
  return bounds(ShapeView<S>(primitive), t);
}

/// The box around a child of the body at `body`. Its transform is composed within the visit: the part that a shape does
/// not use, like a sphere's rotation, is not computed.
template <class S>
ISO_INLINE constexpr Aabb<S> bounds(const Child<S>& child, const Transform<S>& body, Contents<S> contents = {}) {
  return visit_shape(contents.view(child.primitive), [&](const auto& shape) ISO_INLINE_LAMBDA {
    return shape.bounds(compose(body, Transform<S>::of(child.pose)));
  });
}

/// The box around all children; at least one.
template <class S>
ISO_INLINE constexpr Aabb<S> bounds(std::span<const Child<S>> children, const Transform<S>& body,
                                    Contents<S> contents = {}) {
  ISO_ASSERT(!children.empty());
  Aabb<S> box = bounds(children[0], body, contents);
  for (std::size_t i = 1; i < children.size(); ++i) box = merge(box, bounds(children[i], body, contents));
  return box;
}

}  // namespace isostep
