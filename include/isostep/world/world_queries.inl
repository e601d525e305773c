// World<S>: its queries.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/environment.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

template <class S>
std::optional<RayCastHit<S>> World<S>::cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter) const {
  return pin_floats([&] { return engine_->casts_.cast_ray(origin, translation, filter); });
}
template <class S>
void World<S>::cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out,
                            QueryFilter filter) const {
  pin_floats([&] { engine_->casts_.cast_ray_all(origin, translation, out, filter); });
}
template <class S>
std::size_t World<S>::cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::span<RayCastHit<S>> out,
                                   QueryFilter filter) const {
  return pin_floats([&] { return engine_->casts_.cast_ray_all(origin, translation, out, filter); });
}
template <class S>
std::optional<ShapeCastHit<S>> World<S>::cast_shape(const QueryShape<S>& shape, const Pose<S>& pose,
                                                    Vec3<S> translation, QueryFilter filter) const {
  return pin_floats([&] { return engine_->casts_.cast_shape({shape, pose, translation, filter}); });
}
template <class S>
void World<S>::cast_shape_all(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                              std::vector<ShapeCastHit<S>>& out, QueryFilter filter) const {
  pin_floats([&] { engine_->casts_.cast_shape_all({shape, pose, translation, filter}, out); });
}
template <class S>
std::size_t World<S>::cast_shape_all(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> translation,
                                     std::span<ShapeCastHit<S>> out, QueryFilter filter) const {
  return pin_floats([&] { return engine_->casts_.cast_shape_all({shape, pose, translation, filter}, out); });
}
template <class S> bool World<S>::cast_rays(std::span<const RayCast<S>> rays, std::span<RayCastHit<S>> hits) const {
  return pin_floats([&] { return engine_->casts_.cast_rays(rays, hits, engine_->tools_.runner); });
}
template <class S>
bool World<S>::cast_shapes(std::span<const ShapeCast<S>> casts, std::span<ShapeCastHit<S>> hits) const {
  return pin_floats([&] { return engine_->casts_.cast_shapes(casts, hits, engine_->tools_.runner); });
}
template <class S>
std::optional<ClosestBody<S>> World<S>::closest_point(Vec3<S> point, S max_distance, QueryFilter filter) const {
  return pin_floats([&] { return engine_->overlaps_.closest_point(point, max_distance, filter); });
}
template <class S>
void World<S>::overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                             QueryFilter filter) const {
  pin_floats([&] { engine_->overlaps_.overlap_shape(shape, pose, out, filter); });
}
template <class S>
void World<S>::overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                             QueryFilter filter) const {
  pin_floats([&] { engine_->overlaps_.overlap_shape(shape, pose, out, filter); });
}
template <class S>
std::optional<OverlapHit> World<S>::overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                                  QueryFilter filter) const {
  return pin_floats([&] { return engine_->overlaps_.overlap_first(shape, pose, filter); });
}
template <class S> void World<S>::overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter) const {
  pin_floats([&] { engine_->overlaps_.overlap_aabb(box, out, filter); });
}

}  // namespace isostep
