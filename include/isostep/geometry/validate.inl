// Bodies of validate.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/content.inl"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/surfaces.hpp"
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

namespace detail {
/// Of the blob that a valid primitive names, null where it names none.
template <class S> ShapeFault fault_of_blob(const Primitive<S>& p, const Blob* blob) {
  return visit_shape_type(p.type, [&](auto tag) {
    using Shape = typename decltype(tag)::template Of<S>;
    if constexpr (!Shape::kHasBlob) return ShapeFault::none;
    else if (blob == nullptr || blob->type() != Shape::kType) return ShapeFault::blob_missing;
    else return Shape::fault_of(*static_cast<const typename Shape::Content*>(content_of<S>(*blob)));
  });
}
}  // namespace detail

template <class S> ShapeFault validate(std::span<const Child<S>> children, std::span<const BlobRef> blobs) {
  if (children.empty()) return ShapeFault::no_children;
  const S extent = Limits<S>::extent();
  const Aabb<S> room = Aabb<S>::around(Vec3<S>::zero(), {extent, extent, extent});
  std::uint64_t leaves = 0;
  for (const Child<S>& child : children) {
    const std::uint32_t name = child.primitive.blob;
    const Blob* blob = name != 0 && name <= blobs.size() ? blobs[name - 1].get() : nullptr;
    ShapeFault fault = validate(child.primitive);
    if (fault == ShapeFault::none) fault = validate(child.pose);
    if (fault == ShapeFault::none) fault = detail::fault_of_blob(child.primitive, blob);
    if (fault != ShapeFault::none) return fault;
    leaves += leaves_of<S>({child.primitive, blob == nullptr ? nullptr : content_of<S>(*blob)});
    if (leaves >> 31 != 0) return ShapeFault::too_many_triangles;
    // The position alone first: only then is the box around the child free of overflow.
    if (!contains(room, Aabb<S>{child.pose.position, child.pose.position})) return ShapeFault::outside_extent;
    if (!is_bounded(child.primitive.type)) continue;
    const Child<S> unit = normalised(child);
    const ShapeView<S> view = {unit.primitive, blob == nullptr ? nullptr : content_of<S>(*blob)};
    if (!contains(room, bounds(view, Transform<S>::of(unit.pose)))) return ShapeFault::outside_extent;
  }
  return ShapeFault::none;
}

template <class S> Child<S> normalised(const Child<S>& child) {
  Child<S> result = child;
  result.primitive = visit_shape(child.primitive, [](const auto& shape) { return shape.normalised().primitive(); });
  const Quat<Unit<S>> q = child.pose.orientation;
  if (!detail::is_unit(q.x, q.y, q.z, q.w)) result.pose.orientation = normalise(q);
  return result;
}

}  // namespace isostep
