// Surfaces, meshes and height fields: what they have in common, and how contacts count their triangles.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/geometry/shape.hpp"

namespace isostep {

ISO_INLINE constexpr bool is_surface(ShapeType type) {
  return type == ShapeType::mesh || type == ShapeType::height_field;
}

namespace detail {
/// Calls visit(surface), a TriangleGeometry.
template <class S, class Visit> ISO_INLINE decltype(auto) visit_surface(ShapeView<S> view, Visit&& visit) {
  if (view.primitive.type == ShapeType::mesh) return visit(shape_as<Mesh>(view).surface());
  return visit(shape_as<HeightField>(view).surface());
}
}  // namespace detail

/// Returns how many parts contacts may name: a convex child is one leaf, a surface has one for each
/// triangle.
template <class S> ISO_INLINE std::uint32_t leaves_of(ShapeView<S> view) {
  if (!is_surface(view.primitive.type)) return 1;
  return detail::visit_surface(view, [](const auto& surface) ISO_INLINE_LAMBDA { return surface.triangle_count(); });
}

/// Returns the material that a triangle's number stands for, or null if that is the part's or the body's: so it is for
/// a shape that is no surface.
template <class S> ISO_INLINE const SurfaceMaterial* listed_material(ShapeView<S> view, std::uint32_t triangle) {
  if (!is_surface(view.primitive.type)) return nullptr;
  return detail::visit_surface(view, [&](const auto& surface) ISO_INLINE_LAMBDA -> const SurfaceMaterial* {
    const std::span<const SurfaceMaterial> table = surface.table();
    if (table.empty()) return nullptr;
    const std::size_t number = surface.material(triangle);
    return number < table.size() ? &table[number] : nullptr;
  });
}

struct Leaf {
  std::uint32_t child, triangle;
};
/// The leaves of one child.
struct LeafRange {
  std::uint32_t first, count;
};
/// Returns the leaf with that number among all children of a body. `index` must be in range.
template <class S>
ISO_INLINE Leaf leaf_at(std::span<const Child<S>> children, Contents<S> contents, std::uint32_t index) {
  for (std::uint32_t i = 0; i < children.size(); ++i) {
    const std::uint32_t leaves = leaves_of<S>(contents.view(children[i].primitive));
    if (index < leaves) return {i, index};
    index -= leaves;
  }
  return {0, 0};
}

}  // namespace isostep
