// Directions by fixed-point arithmetic, rounded to integers: one result on every machine, for every scalar.
// SPDX-License-Identifier: MIT
#include "fracture_directions.hpp"

#include "isostep/math/vec3.hpp"
#include "isostep/scalar/fixed.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::detail {
namespace {

using Wide = Q32_32;
constexpr int kDigits = 16;                  // of kSpokeLength
constexpr std::int64_t kTurn = 26986075409;  // 2 pi 2^32

GridVector on_grid(Vec3<Unit<Wide>> v) {
  return {nearest_scaled(v.x, kDigits), nearest_scaled(v.y, kDigits), nearest_scaled(v.z, kDigits)};
}

}  // namespace

Frame3 frame_along(GridVector direction) {
  const auto number = [](std::int64_t v) { return Wide(static_cast<std::int32_t>(v)); };
  const Vec3<Unit<Wide>> axis = normalise(Vec3<Wide>{number(direction.x), number(direction.y), number(direction.z)});
  const Tangents<Unit<Wide>> across = tangents_of(axis);
  return {on_grid(axis), on_grid(across.t), on_grid(across.u)};
}

GridVector Frame3::combined(std::int64_t a, std::int64_t b, std::int64_t c) const {
  const auto component = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return (a * x + b * y + c * z + kSpokeLength / 2) >> kDigits;
  };
  return {component(axis.x, t.x, u.x), component(axis.y, t.y, u.y), component(axis.z, t.z, u.z)};
}

GridVector Frame3::spoke(std::uint32_t turn) const {
  const std::int64_t angle = static_cast<std::int64_t>((Int128(kTurn) * std::int64_t{turn}) >> 32);
  const SinCos<Unit<Wide>> at = sin_cos_to<Unit<Wide>>(Wide::from_raw(angle));
  return combined(0, nearest_scaled(at.cos, kDigits), nearest_scaled(at.sin, kDigits));
}

}  // namespace isostep::detail
