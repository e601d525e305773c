// S14's queries of Bullet's world.
// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletDynamicsCommon.h>

#include <optional>
#include <vector>

#include "engine.hpp"

namespace isostep::bench {

/// Bullet has no batches. Static bodies have a group of their own, which the last two kinds leave out.
class BulletQueries {
 public:
  void take(const scenes::DrawnQueries& drawn);
  std::optional<Answered> ask(btCollisionWorld& world, Query query);

 private:
  struct Line {
    btVector3 from, to;  // [m]
  };

  std::uint64_t hits_of(btCollisionWorld& world, Query query);
  std::uint64_t first_hits(btCollisionWorld& world) const;
  std::uint64_t cast_hits(btCollisionWorld& world) const;
  std::uint64_t all_hits(btCollisionWorld& world) const;
  std::uint64_t overlaps(btCollisionWorld& world);

  std::vector<Line> rays_, casts_;
  btSphereShape ball_{static_cast<btScalar>(scenes::kCastRadius)};
  btBoxShape box_{btVector3(static_cast<btScalar>(scenes::kCastHalf.x), static_cast<btScalar>(scenes::kCastHalf.y),
                            static_cast<btScalar>(scenes::kCastHalf.z))};
  btSphereShape large_{static_cast<btScalar>(scenes::kOverlapRadius)};
};

}  // namespace isostep::bench
