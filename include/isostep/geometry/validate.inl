// Bodies of validate.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/validate.hpp"

namespace isostep {
template <class S> ShapeFault validate(const Primitive<S>& p) {
  if (static_cast<std::uint32_t>(p.type) >= kShapeTypes) return ShapeFault::unknown_type;
  if (!is_finite(p.half) || !is_finite(p.radius) || !is_finite(p.normal) || !is_finite(p.offset)) {
    return ShapeFault::not_finite;
  }
  return visit_shape(
      p, [&](const auto& shape) { return shape.primitive() == p ? shape.fault() : ShapeFault::unused_field_set; });
}

template <class S> ShapeFault validate(const Pose<S>& pose) {
  const Quat<Unit<S>> q = pose.orientation;
  if (!is_finite(pose.position) || !is_finite(q.x) || !is_finite(q.y) || !is_finite(q.z) || !is_finite(q.w)) {
    return ShapeFault::not_finite;
  }
  return detail::nearly_unit(q.x, q.y, q.z, q.w) ? ShapeFault::none : ShapeFault::orientation_not_unit;
}

template <class S> ShapeFault validate(std::span<const Child<S>> children) {
  if (children.empty()) return ShapeFault::no_children;
  const S extent = Limits<S>::extent();
  const Aabb<S> room = Aabb<S>::around(Vec3<S>::zero(), {extent, extent, extent});
  for (const Child<S>& child : children) {
    ShapeFault fault = validate(child.primitive);
    if (fault == ShapeFault::none) fault = validate(child.pose);
    if (fault != ShapeFault::none) return fault;
    // The position alone first: only then is the box around the child free of overflow.
    if (!contains(room, Aabb<S>{child.pose.position, child.pose.position})) return ShapeFault::outside_extent;
    if (!is_bounded(child.primitive.type)) continue;
    const Child<S> unit = normalised(child);
    if (!contains(room, bounds(unit.primitive, Transform<S>::of(unit.pose)))) return ShapeFault::outside_extent;
  }
  return ShapeFault::none;
}

template <class S> ShapeFault validate_blob(const Primitive<S>& p, const Blob* blob) {
  return visit_shape(p, [&](const auto& shape) {
    using Shape = std::remove_cvref_t<decltype(shape)>;
    if constexpr (!Shape::kHasBlob) return ShapeFault::none;
    else if (blob == nullptr || blob->type() != Shape::kType) return ShapeFault::blob_missing;
    else return shape.fault_of(*blob);
  });
}

template <class S> Child<S> normalised(const Child<S>& child) {
  Child<S> result = child;
  result.primitive = visit_shape(child.primitive, [](const auto& shape) { return shape.normalised().primitive(); });
  const Quat<Unit<S>> q = child.pose.orientation;
  if (!detail::is_unit(q.x, q.y, q.z, q.w)) result.pose.orientation = normalise(q);
  return result;
}

}  // namespace isostep
