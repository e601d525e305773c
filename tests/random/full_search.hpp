// The results of a world's queries by a search of every part of every body: no tree, and nothing is left out early.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/shape_core.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/collision/query/solid_cast.inl"
#include "isostep/dynamics/solvers/schedule.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/baked/surface_queries.inl"
#include "unit/world/worlds.hpp"

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

template <class S> class FullSearch {
 public:
  explicit FullSearch(const World<S>& world) : world_(world), bodies_(world.bodies()) {}

  std::vector<RayCastHit<S>> cast_ray(Vec3<S> origin, Vec3<S> translation, const QueryFilter& f) const {
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

  /// Casts a shape of one part that lies in its frame as it is.
  std::vector<ShapeCastHit<S>> cast_shape(const ShapeCast<S>& asked) const {
    std::vector<ShapeCastHit<S>> all;
    visit_shape(view_of(asked.shape), [&](const auto& solid) {
      if constexpr (kIsSolid<std::remove_cvref_t<decltype(solid)>>) {
        const ShapeCore<S> core(solid, S(0));
        const S touch = min(detail::kDeepOverlap<S>, solid.inner_radius() * S(0.25));
        all = cast_core(core.core(), touch, asked);
      }
    });
    return all;
  }

  std::vector<OverlapHit> overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, const QueryFilter& f) const {
    std::vector<OverlapHit> all;
    const ShapeView<S> asked = view_of(shape);
    const Transform<S> here = Transform<S>::of({Vec3<S>::zero(), pose.orientation});
    visit_parts(
        f,
        [&](BodyId id, std::uint32_t child, const ShapeView<S>& part, const Transform<S>& at) {
          Manifold<S> manifold;
          if (!is_surface(part.primitive.type)) {
            collide(asked, here, part, at, S(0), manifold);
            if (manifold.count != 0) all.push_back({id, child, 0, 0});
            return;
          }
          detail::visit_surface(part, [&](const auto& surface) {
            for (std::uint32_t triangle = 0; triangle < surface.triangle_count(); ++triangle) {
              if (!surface.has_triangle(triangle)) continue;
              collide_with_triangle(asked, here, part, triangle, at, S(0), manifold);
              if (manifold.count != 0) all.push_back({id, child, triangle, surface.material(triangle)});
            }
          });
        },
        pose.position);
    return first_of_each(all, f.per);
  }

  std::optional<ClosestBody<S>> closest_point(Vec3<S> point, S most, const QueryFilter& f) const {
    std::optional<ClosestBody<S>> best;
    visit_parts(f, [&](BodyId id, std::uint32_t child, const ShapeView<S>& part, const Transform<S>& at) {
      const ClosestPoint<S> found = isostep::closest_point(part, at, point);
      const bool nearer =
          !best || found.distance < best->distance || (found.distance == best->distance && id.slot < best->body.slot);
      if (found.distance <= most && nearer) best = ClosestBody<S>{id, child, found.point, found.normal, found.distance};
    });
    return best;
  }

 private:
  bool sees(const QueryFilter& f, BodyId id, const Child<S>& part) const {
    const BodyProperties<S>& body = *world_.view(id).properties;
    const bool own = (part.traits.flags & part_flag::kOwnFilter) != 0;
    const Filter filter = own ? part.traits.filter : body.filter;
    const bool sensor = (body.flags & body_flag::kSensor) != 0 || (part.traits.flags & part_flag::kSensor) != 0;
    return is_enabled(body) && (filter.category & f.mask) != 0 && (f.sensors || !sensor) && !(f.ignore == id) &&
           (f.group == 0 || filter.group != f.group);
  }
  /// visit(id, child, part, transform) for every part that the filter sees, from an origin.
  template <class Visit> void visit_parts(const QueryFilter& f, const Visit& visit, Vec3<S> origin = {}) const {
    for (const BodyId id : bodies_) {
      const BodyView<S> view = world_.view(id);
      Pose<S> pose = view.pose;
      pose.position -= origin;
      const Transform<S> placed = Transform<S>::of(pose);
      for (std::uint32_t i = 0; i < view.children.size(); ++i) {
        const Child<S>& child = view.children[i];
        if (!sees(f, id, child)) continue;
        visit(id, i, view.contents.view(child.primitive), compose(placed, Transform<S>::of(child.pose)));
      }
    }
  }
  ShapeView<S> view_of(const QueryShape<S>& shape) const {
    if (!shape.of_world) return {shape.primitive, nullptr};
    const std::vector<Child<S>>& parts = world_.state().shapes[shape.id.slot]->children;
    return world_.view(bodies_.front()).contents.view(parts[0].primitive);
  }
  std::vector<ShapeCastHit<S>> cast_core(const ConvexCore<S>& core, S touch, const ShapeCast<S>& asked) const {
    std::vector<ShapeCastHit<S>> all;
    const QueryFilter& f = asked.filter;
    const SolidCast<S> cast = {core,
                               Transform<S>::of(asked.pose),
                               {asked.translation, Unit<S>(1), touch},
                               f.back_faces,
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
  /// Sorts hits in canonical order, by comparison of all that they say; then takes the first of each body, child or
  /// triangle.
  template <class Hit> static std::vector<Hit> listed(std::vector<Hit> all, HitPer per) {
    const auto key = [](const Hit& h) { return std::tuple(to_double(h.fraction), h.body.slot, h.child, h.triangle); };
    std::sort(all.begin(), all.end(), [&](const Hit& a, const Hit& b) { return key(a) < key(b); });
    return first_of_each(all, per);
  }
  template <class Hit> static std::vector<Hit> first_of_each(const std::vector<Hit>& all, HitPer per) {
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

  const World<S>& world_;
  const std::vector<BodyId> bodies_;
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
