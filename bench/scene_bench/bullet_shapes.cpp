// Bullet's shapes.
// SPDX-License-Identifier: MIT
#include "bullet_shapes.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <LinearMath/btConvexHullComputer.h>

namespace isostep::bench {
namespace {

/// Bullet adds its margin around the points, so faces first go inwards by as much: as the margins of its boxes.
std::unique_ptr<btCollisionShape> hull_of(const PeerPart& part) {
  std::vector<btScalar> numbers;
  for (const Vec3<double>& point : part.points) {
    for (const double x : {point.x, point.y, point.z}) numbers.push_back(bt(x));
  }
  btConvexHullComputer inner;
  const btScalar margin = inner.compute(numbers.data(), static_cast<int>(3 * sizeof(btScalar)),
                                        static_cast<int>(part.points.size()), CONVEX_DISTANCE_MARGIN, bt(0.5));
  auto hull = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < inner.vertices.size(); ++i) hull->addPoint(inner.vertices[i], false);
  hull->setMargin(margin);
  hull->recalcLocalAabb();
  return hull;
}

/// The margin is around it, and there is no shape of it with one inside: so a thin one.
std::unique_ptr<btCollisionShape> cone_of(btScalar radius, btScalar half_height) {
  auto cone = std::make_unique<btConeShape>(radius, 2 * half_height);
  cone->setMargin(bt(0.001));
  return cone;
}

std::unique_ptr<btCollisionShape> convex_of(const PeerPart& part) {
  const btScalar radius = bt(part.radius), half = bt(part.half_height);
  switch (part.type) {
    case ShapeType::sphere: return std::make_unique<btSphereShape>(radius);
    case ShapeType::capsule: return std::make_unique<btCapsuleShape>(radius, 2 * half);
    case ShapeType::cylinder: return std::make_unique<btCylinderShape>(btVector3(radius, half, radius));
    case ShapeType::cone: return cone_of(radius, half);
    case ShapeType::half_space: return std::make_unique<btStaticPlaneShape>(bt(part.normal), bt(part.offset));
    case ShapeType::hull: return hull_of(part);
    default: return std::make_unique<btBoxShape>(bt(part.half_extents));
  }
}

void make_mesh(BulletShape& made) {
  const PeerSurface& of = *made.surface;
  for (const Vec3<double>& p : of.points) {
    for (const double x : {p.x, p.y, p.z}) made.numbers.push_back(bt(x));
  }
  static_assert(sizeof(int) == sizeof(std::uint32_t));
  int* corners = reinterpret_cast<int*>(const_cast<std::uint32_t*>(of.corners.data()));  // only read
  made.triangles = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(of.corners.size() / 3), corners, static_cast<int>(3 * sizeof(int)),
      static_cast<int>(of.points.size()), made.numbers.data(), static_cast<int>(3 * sizeof(btScalar)));
  auto mesh = std::make_unique<btBvhTriangleMeshShape>(made.triangles.get(), true);
  made.edges = std::make_unique<btTriangleInfoMap>();
  btGenerateInternalEdgeInfo(mesh.get(), made.edges.get());
  made.shape = std::move(mesh);
}

/// Makes a height field between equal heights up and down, for Bullet puts the middle of those at its origin. The
/// diagonal is the same as ours.
void make_field(BulletShape& made) {
  const PeerSurface& of = *made.surface;
  for (const double h : of.heights) made.numbers.push_back(bt(h));
  const btScalar most = bt(of.highest());
  auto field = std::make_unique<btHeightfieldTerrainShape>(static_cast<int>(of.columns), static_cast<int>(of.rows),
                                                           made.numbers.data(), -most, most, 1, false);
  field->setLocalScaling({bt(of.pitch), 1, bt(of.pitch)});
  made.edges = std::make_unique<btTriangleInfoMap>();
  btGenerateInternalEdgeInfo(field.get(), made.edges.get());
  made.shape = std::move(field);
}

}  // namespace

bool turn_to_surface(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a, int index_a,
                     const btCollisionObjectWrapper* b, int part_b, int index_b) {
  if (a->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE)
    btAdjustInternalEdgeContacts(point, a, b, part_a, index_a);
  else btAdjustInternalEdgeContacts(point, b, a, part_b, index_b);
  return true;
}

BulletShape bullet_shape(const PeerPart& part) {
  BulletShape made;
  made.surface = part.surface;
  if (part.type == ShapeType::mesh) make_mesh(made);
  else if (part.type == ShapeType::height_field) make_field(made);
  else made.shape = convex_of(part);
  return made;
}

}  // namespace isostep::bench
