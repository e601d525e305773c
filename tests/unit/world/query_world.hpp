// A world with every shape, and what a search of all of its parts, without trees, says that queries meet.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/collision/query/solid_cast.inl"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/baked/surface_queries.inl"
#include "random/dice.hpp"
#include "random/hull.hpp"

namespace isostep::test {

/// A surface whose tree shows everything, in whatever order.
template <class G> struct Treeless {
  const G& of;

  int exponent() const { return of.exponent(); }
  std::uint32_t triangle_count() const { return of.triangle_count(); }
  MeshBox bounds() const { return of.bounds(); }
  std::uint32_t neighbour(std::uint32_t id, int k) const { return of.neighbour(id, k); }
  TriangleCorners corners(std::uint32_t id) const { return of.corners(id); }
  BakedTriangle triangle(std::uint32_t id) const { return of.triangle(id); }
  template <class Overlaps, class Visit> bool traverse(GridVector, Overlaps&&, Visit&& visit) const {
    for (std::uint32_t id = of.triangle_count(); id-- > 0;) {
      if (of.has_triangle(id) && !visit(id)) return false;
    }
    return true;
  }
};

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
    const D3 by = dice.direction() * dice.in(0, 18);
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

  bool sees(const QueryFilter& f, BodyId id) const {
    const BodyProperties<S>& body = *world.view(id).properties;
    return (body.filter.category & f.mask) != 0 && (f.sensors || (body.flags & body_flag::kSensor) == 0) &&
           !(f.ignore == id) && (f.group == 0 || body.filter.group != f.group);
  }
  /// visit(id, child, part, transform) for every part that the filter sees.
  template <class Visit> void visit_parts(const QueryFilter& f, const Visit& visit) {
    for (const BodyId id : bodies()) {
      if (!sees(f, id)) continue;
      const BodyView<S> view = world.view(id);
      const Transform<S> placed = Transform<S>::of(view.pose);
      for (std::uint32_t i = 0; i < view.children.size(); ++i) {
        const Child<S>& child = view.children[i];
        visit(id, i, view.contents.view(child.primitive), compose(placed, Transform<S>::of(child.pose)));
      }
    }
  }

  std::vector<RayCastHit<S>> all_of_ray(Vec3<S> origin, Vec3<S> translation, const QueryFilter& f) {
    std::vector<RayCastHit<S>> all;
    visit_parts(f, [&](BodyId id, std::uint32_t child, const ShapeView<S>& part, const Transform<S>& at) {
      const auto add = [&](const RayHit<S>& hit) {
        if (hit.inside && f.start_inside == StartInside::ignore) return;
        all.push_back({id, child, hit.triangle, origin + translation * hit.fraction, hit.normal, hit.fraction,
                       hit.material, hit.inside});
      };
      if (!is_surface(part.primitive.type)) {
        RayHit<S> hit;
        if (ray_cast(part, at, origin, translation, S(1), hit)) add(hit);
        return;
      }
      detail::visit_surface(part, [&](const auto& surface) {
        const auto ray = detail::LocalRay<S>::of(at, origin, translation);
        std::vector<detail::LocalHit<S>> hits;
        cast_through_surface(Treeless<std::remove_cvref_t<decltype(surface)>>{surface}, ray, {S(1), f.back_faces},
                             RayTaker<S>{&hits, [](void* user, const detail::LocalHit<S>& hit) {
                                           static_cast<std::vector<detail::LocalHit<S>>*>(user)->push_back(hit);
                                         }});
        for (const auto& h : hits) add({h.fraction, at.rotation * h.normal, false, h.material, h.triangle});
      });
    });
    return listed(all, f.per);
  }

  std::vector<ShapeCastHit<S>> all_of_cast(const ConvexCore<S>& core, S touch, const Transform<S>& start,
                                           Vec3<S> translation, const QueryFilter& f) {
    std::vector<ShapeCastHit<S>> all;
    const SolidCast<S> cast = {core, start, {translation, Unit<S>(1), touch}, f.back_faces,
                               f.start_inside == StartInside::ignore};
    visit_parts(f, [&](BodyId id, std::uint32_t child, const ShapeView<S>& part, const Transform<S>& at) {
      const auto add = [&](const SolidHit<S>& hit) {
        all.push_back({id, child, hit.triangle, hit.point, hit.normal, hit.fraction, hit.material, hit.inside});
      };
      if (!is_surface(part.primitive.type)) {
        SolidHit<S> hit;
        if (cast_solid(cast, part, at, hit)) add(hit);
        return;
      }
      detail::visit_surface(part, [&](const auto& surface) {
        const Treeless<std::remove_cvref_t<decltype(surface)>> flat = {surface};
        detail::SurfaceCast<S, std::remove_cvref_t<decltype(flat)>>(cast, flat, at).run([&](const SolidHit<S>& hit) {
          add(hit);
          return Unit<S>(1);
        });
      });
    });
    return listed(all, f.per);
  }

  World<S> world;
  Dice dice;

 private:
  /// In canonical order, by comparison of all that it says; then the first of each body or child.
  template <class Hit> static std::vector<Hit> listed(std::vector<Hit> all, HitPer per) {
    const auto key = [](const Hit& h) { return std::tuple(to_double(h.fraction), h.body.slot, h.child, h.triangle); };
    std::sort(all.begin(), all.end(), [&](const Hit& a, const Hit& b) { return key(a) < key(b); });
    std::vector<Hit> list;
    for (const Hit& hit : all) {
      const bool known = std::any_of(list.begin(), list.end(), [&](const Hit& h) {
        return h.body == hit.body && (per == HitPer::body || h.child == hit.child) &&
               (per != HitPer::triangle || h.triangle == hit.triangle);
      });
      if (!known) list.push_back(hit);
    }
    return list;
  }

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
  /// So many parts that they have a tree, one of them without an end.
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

template <class S, class F> void expect_same(const QueryHit<S, F>& a, const QueryHit<S, F>& b, int query) {
  ASSERT_EQ(a.body, b.body) << query;
  ASSERT_EQ(a.child, b.child) << query;
  ASSERT_EQ(a.triangle, b.triangle) << query;
  ASSERT_EQ(a.material, b.material) << query;
  ASSERT_EQ(a.inside, b.inside) << query;
  ASSERT_EQ(a.fraction, b.fraction) << query;
  ASSERT_EQ(a.normal, b.normal) << query;
  ASSERT_EQ(a.point, b.point) << query;
}

}  // namespace isostep::test
