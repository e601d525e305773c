// S14's queries of a world of ours.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "engine.hpp"
#include "isostep/world/world.hpp"

namespace isostep::bench {

/// The terrain has a category of its own, which the last two kinds do not ask for.
template <class S> class OurQueries {
 public:
  static constexpr std::uint32_t kTerrain = 2;

  void take(const scenes::DrawnQueries& drawn) {
    const Primitive<S> ball = primitive_of(Sphere<S>{from_double<S>(scenes::kCastRadius)});
    const Primitive<S> box = primitive_of(Box<S>{vec(scenes::kCastHalf)});
    rays_.clear();
    casts_.clear();
    for (const scenes::DrawnLine& line : drawn.rays) rays_.push_back({vec(line.from), vec(line.way), {}});
    for (const scenes::DrawnLine& line : drawn.casts) {
      const Pose<S> pose = {vec(line.from), Quat<Unit<S>>::identity()};
      casts_.push_back({casts_.size() % 2 == 0 ? ball : box, pose, vec(line.way), {}});
    }
    ray_hits_.resize(rays_.size());
    cast_hits_.resize(casts_.size());
  }

  Answered ask(const World<S>& world, Query query) {
    const double start = thread_milliseconds();
    const std::uint64_t hits = hits_of(world, query);
    return {thread_milliseconds() - start, hits};
  }

 private:
  static Vec3<S> vec(scenes::Point p) { return {from_double<S>(p.x), from_double<S>(p.y), from_double<S>(p.z)}; }
  static QueryFilter of_bodies() {
    QueryFilter filter;
    filter.mask = ~kTerrain;
    return filter;
  }
  template <class Hits> static std::uint64_t count(const Hits& hits) {
    return static_cast<std::uint64_t>(
        std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return static_cast<bool>(hit.body); }));
  }

  std::uint64_t hits_of(const World<S>& world, Query query) {
    switch (query) {
      case Query::ray: return first_hits(world);
      case Query::rays: return world.cast_rays(rays_, ray_hits_) ? count(ray_hits_) : 0;
      case Query::cast: return cast_hits(world);
      case Query::casts: return world.cast_shapes(casts_, cast_hits_) ? count(cast_hits_) : 0;
      case Query::overlap: return overlaps(world);
      case Query::all_hits: break;
    }
    return all_hits(world);
  }
  std::uint64_t first_hits(const World<S>& world) const {
    std::uint64_t hits = 0;
    for (const RayCast<S>& ray : rays_) hits += world.cast_ray(ray.origin, ray.translation) ? 1 : 0;
    return hits;
  }
  std::uint64_t cast_hits(const World<S>& world) const {
    std::uint64_t hits = 0;
    for (const ShapeCast<S>& cast : casts_) hits += world.cast_shape(cast.shape, cast.pose, cast.translation) ? 1 : 0;
    return hits;
  }
  std::uint64_t overlaps(const World<S>& world) {
    const Primitive<S> ball = primitive_of(Sphere<S>{from_double<S>(scenes::kOverlapRadius)});
    bodies_.clear();
    for (const ShapeCast<S>& cast : casts_) world.overlap_shape(ball, cast.pose, bodies_, of_bodies());
    return bodies_.size();
  }
  std::uint64_t all_hits(const World<S>& world) {
    list_.clear();
    for (std::size_t i = 0; i < std::min(kListRays, rays_.size()); ++i) {
      world.cast_ray_all(rays_[i].origin, rays_[i].translation, list_, of_bodies());
    }
    return list_.size();
  }

  std::vector<RayCast<S>> rays_;
  std::vector<ShapeCast<S>> casts_;
  std::vector<RayCastHit<S>> ray_hits_, list_;
  std::vector<ShapeCastHit<S>> cast_hits_;
  std::vector<BodyId> bodies_;
};

}  // namespace isostep::bench
