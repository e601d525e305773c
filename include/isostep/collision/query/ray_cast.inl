// Body of ray_cast.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/geometry/baked/polyhedron_surface.inl"

namespace isostep {

template <class S>
bool ray_cast(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> origin,
              Vec3<S> translation, S max_fraction, RayHit<S>& hit) {
  const detail::LocalHit<S> found =
      visit_shape(shape, [&](const auto& visited) { return visited.cast(transform, origin, translation); });
  if (found.kind == detail::LocalHit<S>::missed || found.fraction > max_fraction) return false;
  hit.fraction = found.fraction;
  hit.normal = found.kind == detail::LocalHit<S>::inside ? -normalise(translation) : transform.rotation * found.normal;
  return true;
}

}  // namespace isostep
