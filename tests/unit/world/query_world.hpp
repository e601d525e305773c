// A world with every shape that lies, falls and senses, and random questions about it.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "random/dice.hpp"
#include "random/full_search.hpp"
#include "random/hull.hpp"

namespace isostep::test {

template <class S> class QueryWorld {
 public:
  explicit QueryWorld(std::uint64_t seed) : world(settings<S>(-10, 60, 4)), dice(seed) {
    add_terrain_of(false, {-6, 0, 0});
    add_terrain_of(true, {6, 0, 0});
    world.create(still<S>(world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, num<S>(-2)})));
    for (int i = 0; i < 60; ++i) add_body(i);
    for (int i = 0; i < 90; ++i) world.step();
  }

  /// Rays and ways of casts: through all of it, along it, and out of it.
  D3 place() { return {dice.in(-11, 11), dice.in(-1, 5), dice.in(-6, 6)}; }
  Vec3<S> way(int kind) {
    const D3 by = dice.arrow(0, 18);
    return vec<S>(kind % 3 == 0 ? D3{by.x, -std::fabs(by.y), by.z} : by);
  }
  QueryFilter filter() {
    QueryFilter f;
    f.mask = dice.one_in(4) ? 2u : 0xffffffffu;
    f.sensors = dice.one_in(2);
    if (dice.one_in(4)) f.ignore = bodies()[dice.below(static_cast<std::uint32_t>(bodies().size()))];
    f.group = dice.one_in(4) ? 3 : 0;
    f.back_faces = dice.one_in(3);
    f.start_inside = dice.one_in(3) ? StartInside::ignore : StartInside::report;
    f.per = static_cast<HitPer>(dice.below(3));
    return f;
  }
  const std::vector<BodyId>& bodies() {
    if (bodies_.empty()) bodies_ = world.bodies();
    return bodies_;
  }
  const std::vector<ShapeId>& solids() const { return solids_; }

  World<S> world;
  Dice dice;

 private:
  void add_terrain_of(bool field, D3 at) {
    constexpr std::uint32_t kPlaces = 13;
    constexpr double kPitch = 1, kHalf = 6;
    std::vector<double> heights;
    for (std::uint32_t i = 0; i < kPlaces * kPlaces; ++i) heights.push_back(dice.one_in(3) ? 0 : dice.in(-1, 0.5));
    std::vector<BlobRef> blobs;
    std::vector<Child<S>> children = {{{}, Pose<S>::identity()}};
    if (field) {
      std::vector<std::uint8_t> materials;
      for (std::uint32_t i = 0; i < (kPlaces - 1) * (kPlaces - 1); ++i)
        materials.push_back(i == 30 ? BakedHeightField::kHole : static_cast<std::uint8_t>(i % 5));
      blobs.push_back(height_field_blob({kPlaces, kPlaces, kPitch}, heights, materials).value());
      children[0].primitive = primitive_of(HeightField<S>{1});
      children[0].pose.position = vec<S>(-kHalf, 0, -kHalf);
    } else {
      std::vector<D3> points;
      std::vector<MeshTriangle> triangles;
      std::vector<std::uint8_t> materials;
      for (std::uint32_t k = 0; k < kPlaces; ++k) {
        for (std::uint32_t i = 0; i < kPlaces; ++i) {
          points.push_back({kPitch * i - kHalf, heights[k * kPlaces + i], kPitch * k - kHalf});
          if (i + 1 == kPlaces || k + 1 == kPlaces) continue;
          const std::uint32_t from = k * kPlaces + i;
          triangles.push_back({{from, from + kPlaces, from + 1}});
          triangles.push_back({{from + kPlaces + 1, from + 1, from + kPlaces}});
          materials.insert(materials.end(), {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(k)});
        }
      }
      blobs.push_back(mesh_blob(points, triangles, materials).value());
      children[0].primitive = primitive_of(Mesh<S>{1});
    }
    children.push_back(part_at(primitive_of(Box<S>{vec<S>(0.5, 1, 0.5)}), {2, 0.5, 2}));
    if (field) add_fence(children);
    BodyDefinition<S> d = still<S>(world.add_shape(std::span<const Child<S>>(children), blobs), at);
    d.orientation = turn<S>({0, 1, 0}, field ? 0.3 : -0.2);
    d.filter.category = 3;
    world.create(d);
  }
  /// Adds so many parts that they have a tree, one of them without an end.
  static void add_fence(std::vector<Child<S>>& children) {
    children.push_back(
        {primitive_of(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, num<S>(-3)}), Pose<S>::identity()});
    for (int i = 0; i < 12; ++i) {
      children.push_back(part_at(primitive_of(Box<S>{vec<S>(0.1, 0.7, 0.1)}), {i - 5.5, 0.2, 0.4 * i - 2}));
      children.back().pose.orientation = turn<S>({0, 0, 1}, 0.2 * i);
    }
  }
  ShapeId draw_shape(int kind) {
    const D3 half = {dice.in(0.15, 0.7), dice.in(0.15, 0.7), dice.in(0.15, 0.7)};
    switch (kind) {
      case 0: return world.add_shape(Sphere<S>{num<S>(half.x)});
      case 1: return world.add_shape(Capsule<S>{num<S>(half.x), num<S>(half.y)});
      case 2: return world.add_shape(Box<S>{vec<S>(half)});
      case 3: return add_hull(world, draw_hull(dice, half), half.y > 0.5 ? half.x / 4 : 0);
      default: {
        const Child<S> parts[] = {part_at(primitive_of(Box<S>{vec<S>(half)}), {0.5, 0, 0}),
                                  part_at(primitive_of(Sphere<S>{num<S>(half.y)}), {-0.5, 0, 0}),
                                  part_at(primitive_of(Capsule<S>{num<S>(half.x), num<S>(half.z)}), {0, 0.5, 0})};
        return world.add_shape(std::span<const Child<S>>(parts));
      }
    }
  }
  void add_body(int i) {
    const ShapeId shape = draw_shape(i % 5);
    if (i % 5 < 4) solids_.push_back(shape);
    BodyDefinition<S> d = moving<S>(shape, {dice.in(-10, 10), dice.in(1, 5), dice.in(-5, 5)});
    d.orientation = dice.orientation<S>();
    if (i % 4 == 0) d.type = BodyType::static_;
    if (i % 3 == 0) d.filter.category = 2;
    if (i % 7 == 0) d.filter.group = 3;
    d.sensor = i % 9 == 0;
    world.create(d);
  }

  std::vector<BodyId> bodies_;
  std::vector<ShapeId> solids_;
};

}  // namespace isostep::test
