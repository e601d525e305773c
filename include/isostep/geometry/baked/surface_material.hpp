// Materials of triangles: a number for each, and what the numbers stand for.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/core/result.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

/// The number of a triangle of another surface that lies beside this one. Nothing touches or hits it; it only tells the
/// triangles beside it how the ground goes on, as any neighbour does: see TriangleGeometry.
inline constexpr std::uint8_t kGhostMaterial = 254;

/// The material that a number stands for: it replaces friction and restitution of the body's; the rest is the body's.
struct SurfaceMaterial {
  static constexpr int kBits = 10;  // a whole is 1 << kBits
  static constexpr std::uint16_t kMostFriction = 16 << kBits, kMostRestitution = 1 << kBits;

  std::uint16_t friction, restitution;

  friend ISO_INLINE constexpr bool operator==(SurfaceMaterial a, SurfaceMaterial b) {
    return a.friction == b.friction && a.restitution == b.restitution;
  }
  ISO_FIELDS(friction, restitution)
};

/// Makes a material, rounded to 1/1024. ErrorCode::invalid: a friction that is not 0 to 16, a restitution that is not 0
/// to 1.
Result<SurfaceMaterial> surface_material(double friction, double restitution);

/// The materials that builders of surfaces take. `numbers` has one a triangle or cell, or none at all, which is 0 for
/// each. `table` has the material of number 0, then 1 ...; numbers beyond it stand for the body's own material.
struct SurfaceMaterials {
  static constexpr std::uint32_t kMost = kGhostMaterial;  // of a table

  std::span<const std::uint8_t> numbers;
  std::span<const SurfaceMaterial> table;

  ISO_INLINE constexpr SurfaceMaterials() = default;
  template <class Numbers>
  requires std::convertible_to<const Numbers&, std::span<const std::uint8_t>> ISO_INLINE constexpr SurfaceMaterials(
      const Numbers& of_each, std::span<const SurfaceMaterial> of_numbers = {})
      : numbers(of_each), table(of_numbers) {}
};

}  // namespace isostep
