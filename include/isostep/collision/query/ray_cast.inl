// Bodies of ray_cast.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/geometry/baked/polyhedron_surface.inl"
#include "isostep/geometry/baked/rounded_polyhedron.inl"

namespace isostep {
namespace detail {

template <class S>
ISO_INLINE RayHit<S> placed_hit(const LocalHit<S>& found, const Transform<S>& transform, Vec3<S> translation) {
  const bool inside = found.kind == LocalHit<S>::inside;
  return {found.fraction, inside ? -normalise(translation) : transform.rotation * found.normal, inside, found.material,
          found.triangle};
}

/// Transforms hits of a surface to the caller's frame.
template <class S> struct PlacedTaker {
  const Transform<S>& transform;
  Vec3<S> translation;
  const RayHitTaker<S>& taker;

  static ISO_INLINE void take(void* user, const LocalHit<S>& hit) {
    const PlacedTaker& self = *static_cast<const PlacedTaker*>(user);
    self.taker.take(self.taker.user, placed_hit(hit, self.transform, self.translation));
  }
};

}  // namespace detail

template <class S>
bool ray_cast(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> origin,
              Vec3<S> translation, S max_fraction, RayHit<S>& hit, bool back_faces) {
  using namespace detail;
  const LocalHit<S> found =
      is_surface(shape.primitive.type)
          ? visit_surface(shape,
                          [&](const auto& surface) ISO_INLINE_LAMBDA {
                            const LocalRay<S> ray = LocalRay<S>::of(transform, origin, translation);
                            return cast_on_surface(surface, ray, RayReach<S>{max_fraction, back_faces});
                          })
          : visit_shape(shape, [&](const auto& visited) { return visited.cast(transform, origin, translation); });
  if (found.kind == LocalHit<S>::missed || found.fraction > max_fraction) return false;
  hit = placed_hit(found, transform, translation);
  return true;
}

template <class S>
void ray_cast_all(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> origin,
                  Vec3<S> translation, const RayReach<S>& reach, const RayHitTaker<S>& taker) {
  using namespace detail;
  if (!is_surface(shape.primitive.type)) {
    RayHit<S> hit;
    if (ray_cast(shape, transform, origin, translation, reach.max_fraction, hit)) taker.take(taker.user, hit);
    return;
  }
  visit_surface(shape, [&](const auto& surface) ISO_INLINE_LAMBDA {
    PlacedTaker<S> placed = {transform, translation, taker};
    cast_through_surface(surface, LocalRay<S>::of(transform, origin, translation), reach,
                         RayTaker<S>{&placed, &PlacedTaker<S>::take});
  });
}

}  // namespace isostep
