// Types that queries of worlds are given and return.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/id.hpp"
#include "isostep/geometry/primitive.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// The answer of a query about a shape that a ray or cast starts in. A mesh or height field has no inside: a ray starts
/// outside of it, a cast starts inside of triangles that it overlaps.
enum class StartInside : std::uint8_t {
  report,  // a hit at fraction 0
  ignore   // nothing, wherever it goes
};
/// `all` lists one hit for each of these, the first.
enum class HitPer : std::uint8_t {
  body,
  child,    // of a body's shape
  triangle  // of a mesh or height field; of other children as `child`
};

/// A query sees bodies whose category meets the mask, and sensors only if asked. It does not see the ignored body and
/// those of the group: use this to exclude the caster. A stale id ignores nobody. A part with its own filter, material
/// or sensor flag is judged by that instead of its body's.
struct QueryFilter {
  std::uint32_t mask = 0xffffffffu;
  bool sensors = false;
  BodyId ignore = {};
  std::uint32_t group = 0;  // what is of this Filter::group is not seen; 0: none
  bool back_faces = false;  // rays and casts hit triangles from behind too
  StartInside start_inside = StartInside::report;
  HitPer per = HitPer::body;
  std::span<const BodyId> ignore_all = {};           // nor any of these: a list that outlives the query
  std::span<const std::uint32_t> ignore_kinds = {};  // nor parts of any of these Material::kinds: likewise
};

/// Hits are ordered by fraction, then by the body's slot, child, triangle.
template <class S, class Fraction> struct QueryHit {
  BodyId body;             // null: nothing was hit
  std::uint32_t child;     // of the body's shape
  std::uint32_t triangle;  // of a mesh or height field; else 0
  Vec3<S> point;           // [m] of the surface, world
  Vec3<Unit<S>> normal;    // [1] of the surface, against the ray or the shape that is cast
  Fraction fraction;       // [1] of the translation
  std::uint8_t material;   // of the triangle; 0 where there is none
  bool inside;             // from the start: the normal is the way back of a ray, the shortest way out of a shape
};
/// The point where a ray met a surface.
template <class S> using RayCastHit = QueryHit<S, S>;
/// A part that a cast shape met. The fraction is rounded down, so that the two do not overlap there.
template <class S> using ShapeCastHit = QueryHit<S, Unit<S>>;

/// A part or triangle that a shape overlaps. Ordered by slot, child, triangle.
struct OverlapHit {
  BodyId body;
  std::uint32_t child;     // of the body's shape
  std::uint32_t triangle;  // the lowest, of a mesh or height field; else 0
  std::uint8_t material;   // of the triangle; 0 where there is none

  friend ISO_INLINE bool operator==(const OverlapHit& a, const OverlapHit& b) {
    return a.body == b.body && a.child == b.child && a.triangle == b.triangle && a.material == b.material;
  }
};

/// The body that is nearest to a point.
template <class S> struct ClosestBody {
  BodyId body;
  std::uint32_t child;   // of its shape
  Vec3<S> point;         // [m] on its surface
  Vec3<Unit<S>> normal;  // [1] outward
  S distance;            // [m] negative: inside
};

/// A convex shape to query with: a shape of the world that has one part, or a primitive without a blob.
template <class S> struct QueryShape {
  bool of_world;
  ShapeId id = {};              // where it is of the world
  Primitive<S> primitive = {};  // else

  ISO_INLINE QueryShape(ShapeId shape) : of_world(true), id(shape) {}
  ISO_INLINE QueryShape(const Primitive<S>& shape) : of_world(false), primitive(shape) {}
};

/// One ray of a batch.
template <class S> struct RayCast {
  Vec3<S> origin;       // [m] world
  Vec3<S> translation;  // [m]
  QueryFilter filter = {};
};
/// One cast of a batch.
template <class S> struct ShapeCast {
  QueryShape<S> shape;
  Pose<S> pose;         // [m] of the shape's frame at the start, world
  Vec3<S> translation;  // [m]
  QueryFilter filter = {};
};

}  // namespace isostep
