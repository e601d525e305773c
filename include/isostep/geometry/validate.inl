// Bodies of validate.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/content.inl"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/geometry/validate.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {
template <class S> ShapeFault fault_of(const Primitive<S>& p) {
  if (static_cast<std::uint32_t>(p.type) >= kShapeTypes) return ShapeFault::unknown_type;
  if (!is_finite(p.half) || !is_finite(p.radius) || !is_finite(p.normal) || !is_finite(p.offset)) {
    return ShapeFault::not_finite;
  }
  return visit_shape(
      p, [&](const auto& shape) { return shape.primitive() == p ? shape.fault() : ShapeFault::unused_field_set; });
}
template <class S> ShapeFault fault_of(const Pose<S>& pose) {
  const Quat<Unit<S>> q = pose.orientation;
  if (!is_finite(pose.position) || !is_finite(q.x) || !is_finite(q.y) || !is_finite(q.z) || !is_finite(q.w)) {
    return ShapeFault::not_finite;
  }
  return nearly_unit(q.x, q.y, q.z, q.w) ? ShapeFault::none : ShapeFault::orientation_not_unit;
}
template <class S> Child<S> normalised_part(const Child<S>& child) {
  Child<S> result = child;
  result.primitive = visit_shape(child.primitive, [](const auto& shape) { return shape.normalised().primitive(); });
  const Quat<Unit<S>> q = child.pose.orientation;
  if (!is_unit(q.x, q.y, q.z, q.w)) result.pose.orientation = normalise(q);
  result.traits = child.traits.normalised();
  return result;
}
/// Returns the fault of the blob of a valid primitive, which is null if the primitive names none.
template <class S> ShapeFault fault_of_blob(const Primitive<S>& p, const Blob* blob) {
  return visit_shape_type(p.type, [&](auto tag) {
    using Shape = typename decltype(tag)::template Of<S>;
    if constexpr (!Shape::kHasBlob) return ShapeFault::none;
    else if (blob == nullptr || blob->type() != Shape::kType) return ShapeFault::blob_missing;
    else return Shape::fault_of(*static_cast<const typename Shape::Content*>(content_of<S>(*blob)));
  });
}

/// Returns the field that is NaN or infinite.
template <class S> const char* field_not_finite(const Child<S>& child) {
  const Primitive<S>& p = child.primitive;
  return !is_finite(p.half)                ? "primitive.half"
         : !is_finite(p.radius)            ? "primitive.radius"
         : !is_finite(p.normal)            ? "primitive.normal"
         : !is_finite(p.offset)            ? "primitive.offset"
         : !is_finite(child.pose.position) ? "pose.position"
                                           : "pose.orientation";
}
/// Returns the field that is set although the part's type does not use it.
template <class S> const char* field_unused(const Primitive<S>& p) {
  const Primitive<S> used = visit_shape(p, [](const auto& shape) { return shape.primitive(); });
  return !(used.half == p.half)       ? "primitive.half"
         : !(used.radius == p.radius) ? "primitive.radius"
         : !(used.normal == p.normal) ? "primitive.normal"
         : !(used.offset == p.offset) ? "primitive.offset"
                                      : "primitive.blob";
}
/// Returns the field with the wrong size: the radius, if with a good radius the part would have another fault.
template <class S> const char* field_of_size(const Primitive<S>& p, ShapeFault fault) {
  if (p.blob != 0) return "primitive.blob";
  Primitive<S> other = p;
  other.radius = S(1);
  const ShapeFault with_another = fault_of(other);
  return with_another == fault || with_another == ShapeFault::unused_field_set ? "primitive.half" : "primitive.radius";
}
template <class S> const char* field_of(const Child<S>& child, ShapeFault fault) {
  switch (fault) {
    case ShapeFault::none:
    case ShapeFault::no_children:
    case ShapeFault::too_many_triangles: break;
    case ShapeFault::unknown_type: return "primitive.type";
    case ShapeFault::not_finite: return field_not_finite(child);
    case ShapeFault::unused_field_set: return field_unused(child.primitive);
    case ShapeFault::size_not_positive:
    case ShapeFault::size_too_small:
    case ShapeFault::size_too_large: return field_of_size(child.primitive, fault);
    case ShapeFault::offset_too_large: return "primitive.offset";
    case ShapeFault::normal_not_unit: return "primitive.normal";
    case ShapeFault::orientation_not_unit: return "pose.orientation";
    case ShapeFault::blob_missing:
    case ShapeFault::blob_not_valid: return "primitive.blob";
    case ShapeFault::outside_extent: return "pose.position";
    case ShapeFault::radius_not_in_range: return "primitive.radius";
  }
  return "";
}
/// Checks one part alone. Adds its triangles to `leaves`, the number of those of all parts.
template <class S> ShapeFault fault_of_child(const Child<S>& child, const Blob* blob, std::uint64_t& leaves) {
  ShapeFault fault = fault_of(child.primitive);
  if (fault == ShapeFault::none) fault = fault_of(child.pose);
  if (fault == ShapeFault::none) fault = fault_of_blob(child.primitive, blob);
  if (fault != ShapeFault::none) return fault;
  leaves += leaves_of<S>({child.primitive, blob == nullptr ? nullptr : content_of<S>(*blob)});
  if (leaves >> 31 != 0) return ShapeFault::too_many_triangles;
  const S extent = Limits<S>::extent();
  const Aabb<S> room = Aabb<S>::around(Vec3<S>::zero(), {extent, extent, extent});
  // The position alone first: only then is the box around the child free of overflow.
  if (!contains(room, Aabb<S>{child.pose.position, child.pose.position})) return ShapeFault::outside_extent;
  if (!is_bounded(child.primitive.type)) return ShapeFault::none;
  const Child<S> unit = normalised_part(child);
  const ShapeView<S> view = {unit.primitive, blob == nullptr ? nullptr : content_of<S>(*blob)};
  return contains(room, bounds(view, Transform<S>::of(unit.pose))) ? ShapeFault::none : ShapeFault::outside_extent;
}
}  // namespace detail

template <class S> ShapeFaultPlace find_fault(std::span<const Child<S>> children, std::span<const BlobRef> blobs) {
  return pin_floats([&]() -> ShapeFaultPlace {
    if (children.empty()) return {ShapeFault::no_children, 0, ""};
    std::uint64_t leaves = 0;
    for (std::uint32_t i = 0; i < children.size(); ++i) {
      const std::uint32_t name = children[i].primitive.blob;
      const Blob* blob = name != 0 && name <= blobs.size() ? blobs[name - 1].get() : nullptr;
      const ShapeFault fault = detail::fault_of_child(children[i], blob, leaves);
      if (fault != ShapeFault::none) return {fault, i, detail::field_of(children[i], fault)};
    }
    return {};
  });
}
template <class S> ShapeFault validate(std::span<const Child<S>> children, std::span<const BlobRef> blobs) {
  return find_fault(children, blobs).fault;
}

template <class S> ShapeFault validate(const Primitive<S>& primitive) {
  return pin_floats([&] { return detail::fault_of(primitive); });
}
template <class S> ShapeFault validate(const Pose<S>& pose) {
  return pin_floats([&] { return detail::fault_of(pose); });
}
template <class S> Child<S> normalised(const Child<S>& child) {
  return pin_floats([&] { return detail::normalised_part(child); });
}

}  // namespace isostep
