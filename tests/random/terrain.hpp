// Ground for random worlds: a small mesh or height field over a plane that holds what falls off it.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "random/dice.hpp"

namespace isostep::test {

/// Sixteen metres wide, half a metre of hills, all below 0: what is put over a plane at 0 is over this too.
template <class S> void add_terrain(World<S>& world, std::uint64_t seed, double friction) {
  constexpr std::uint32_t kPlaces = 9;
  constexpr double kPitch = 2, kHalf = 8;  // [m]
  Dice dice(seed * 31337 + 5);
  const bool flat = dice.one_in(4);
  std::vector<double> heights;
  for (std::uint32_t i = 0; i < kPlaces * kPlaces; ++i) heights.push_back(flat ? 0 : -dice.in(0, 0.5));
  std::vector<BlobRef> blobs;
  Child<S> child = {{}, Pose<S>::identity()};
  if (dice.one_in(2)) {
    std::vector<std::uint8_t> materials((kPlaces - 1) * (kPlaces - 1), 0);
    if (dice.one_in(2)) materials[dice.below(static_cast<std::uint32_t>(materials.size()))] = BakedHeightField::kHole;
    blobs.push_back(height_field_blob({kPlaces, kPlaces, kPitch}, heights, materials).value());
    child.primitive = primitive_of(HeightField<S>{1});
    child.pose.position = vec<S>(-kHalf, 0, -kHalf);
  } else {
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (std::uint32_t k = 0; k < kPlaces; ++k) {
      for (std::uint32_t i = 0; i < kPlaces; ++i)
        points.push_back({kPitch * i - kHalf, heights[k * kPlaces + i], kPitch * k - kHalf});
    }
    for (std::uint32_t k = 0; k + 1 < kPlaces; ++k) {
      for (std::uint32_t i = 0; i + 1 < kPlaces; ++i) {
        const std::uint32_t at = k * kPlaces + i;
        triangles.push_back({{at, at + kPlaces, at + 1}});
        triangles.push_back({{at + kPlaces + 1, at + 1, at + kPlaces}});
      }
    }
    blobs.push_back(mesh_blob(points, triangles).value());
    child.primitive = primitive_of(Mesh<S>{1});
  }
  std::vector<Child<S>> children = {child};
  if (dice.one_in(3))  // a boulder that belongs to the ground
    children.push_back({primitive_of(Sphere<S>{num<S>(0.5)}), {vec<S>(3, -0.25, -3), Quat<Unit<S>>::identity()}});
  BodyDefinition<S> d = still<S>(world.add_shape(std::span<const Child<S>>(children), blobs));
  d.material.friction = num<S>(friction);
  world.create(d);
  d = still<S>(world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, num<S>(-1)}));
  d.material.friction = num<S>(friction);
  world.create(d);
}

}  // namespace isostep::test
