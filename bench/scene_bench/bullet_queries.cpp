// Bullet's rays, convex sweeps and contact tests.
// SPDX-License-Identifier: MIT
#include "bullet_queries.hpp"

#include <algorithm>

#include "bullet_shapes.hpp"

namespace isostep::bench {
namespace {

btVector3 place(scenes::Point p) { return {bt(p.x), bt(p.y), bt(p.z)}; }

constexpr int kAllButStatic = btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter;

/// Collects each body once, however many contacts it has.
struct Touched : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper* other, int, int) override {
    if (point.getDistance() <= 0) bodies.push_back(other->getCollisionObject());
    return 0;
  }
  std::uint64_t count() {
    std::sort(bodies.begin(), bodies.end());
    return static_cast<std::uint64_t>(std::unique(bodies.begin(), bodies.end()) - bodies.begin());
  }
  std::vector<const btCollisionObject*> bodies;
};

}  // namespace

void BulletQueries::take(const scenes::DrawnQueries& drawn) {
  const auto lines = [](const std::vector<scenes::DrawnLine>& from) {
    std::vector<Line> made;
    for (const scenes::DrawnLine& line : from) made.push_back({place(line.from), place(line.from) + place(line.way)});
    return made;
  };
  rays_ = lines(drawn.rays);
  casts_ = lines(drawn.casts);
}

std::optional<Answered> BulletQueries::ask(btCollisionWorld& world, Query query) {
  if (query == Query::rays || query == Query::casts) return std::nullopt;
  const double start = thread_milliseconds();
  const std::uint64_t hits = hits_of(world, query);
  return Answered{thread_milliseconds() - start, hits};
}

std::uint64_t BulletQueries::hits_of(btCollisionWorld& world, Query query) {
  switch (query) {
    case Query::ray: return first_hits(world);
    case Query::cast: return cast_hits(world);
    case Query::overlap: return overlaps(world);
    default: return all_hits(world);
  }
}

std::uint64_t BulletQueries::first_hits(btCollisionWorld& world) const {
  std::uint64_t hits = 0;
  for (const Line& line : rays_) {
    btCollisionWorld::ClosestRayResultCallback found(line.from, line.to);
    world.rayTest(line.from, line.to, found);
    hits += found.hasHit() ? 1 : 0;
  }
  return hits;
}

std::uint64_t BulletQueries::cast_hits(btCollisionWorld& world) const {
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < casts_.size(); ++i) {
    const Line& line = casts_[i];
    const btConvexShape& shape = i % 2 == 0 ? static_cast<const btConvexShape&>(ball_) : box_;
    btCollisionWorld::ClosestConvexResultCallback found(line.from, line.to);
    const btQuaternion upright = btQuaternion::getIdentity();
    world.convexSweepTest(&shape, btTransform(upright, line.from), btTransform(upright, line.to), found);
    hits += found.hasHit() ? 1 : 0;
  }
  return hits;
}

std::uint64_t BulletQueries::all_hits(btCollisionWorld& world) const {
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < std::min(kListRays, rays_.size()); ++i) {
    btCollisionWorld::AllHitsRayResultCallback found(rays_[i].from, rays_[i].to);
    found.m_collisionFilterMask = kAllButStatic;
    world.rayTest(rays_[i].from, rays_[i].to, found);
    hits += static_cast<std::uint64_t>(found.m_collisionObjects.size());
  }
  return hits;
}

std::uint64_t BulletQueries::overlaps(btCollisionWorld& world) {
  std::uint64_t hits = 0;
  btCollisionObject ball;
  ball.setCollisionShape(&large_);
  for (const Line& line : casts_) {
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), line.from));
    Touched touched;
    touched.m_collisionFilterMask = kAllButStatic;
    world.contactTest(&ball, touched);
    hits += touched.count();
  }
  return hits;
}

}  // namespace isostep::bench
