// The shapes of a scene as Bullet has them.
// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionShapes/btTriangleInfoMap.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "peer_scene.hpp"

namespace isostep::bench {

inline btScalar bt(double x) { return static_cast<btScalar>(x); }
inline btVector3 bt(Vec3<double> v) { return {bt(v.x), bt(v.y), bt(v.z)}; }
inline btQuaternion bt(Quat<double> q) { return btQuaternion(bt(q.x), bt(q.y), bt(q.z), bt(q.w)).normalized(); }
inline Vec3<double> ours(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// A shape, and what it points to: that goes last.
struct BulletShape {
  std::shared_ptr<const PeerSurface> surface;
  std::vector<btScalar> numbers;  // points of a mesh, heights of a field
  std::unique_ptr<btStridingMeshInterface> triangles;
  std::unique_ptr<btTriangleInfoMap> edges;  // of a mesh or field
  std::unique_ptr<btCollisionShape> shape;
};
BulletShape bullet_shape(const PeerPart& part);
/// A gContactAddedCallback: Bullet's own remedy for bodies that catch on inner edges of a mesh or field.
bool turn_to_surface(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a, int index_a,
                     const btCollisionObjectWrapper* b, int part_b, int index_b);

}  // namespace isostep::bench
