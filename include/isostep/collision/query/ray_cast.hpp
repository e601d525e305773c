// Rays against one primitive.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/surfaces.hpp"

namespace isostep {

template <class S> struct RayHit {
  S fraction;                  // [1] of the translation, 0 ... max_fraction
  Vec3<Unit<S>> normal;        // [1] of the surface, world frame, against the ray
  bool inside = false;         // the shape holds the origin
  std::uint8_t material = 0;   // of the triangle; 0 where the shape has none
  std::uint32_t triangle = 0;  // of a mesh or height field; else 0
};
/// Receives hits one by one, in no order.
template <class S> struct RayHitTaker {
  void* user;
  void (*take)(void* user, const RayHit<S>& hit);
};

/// Finds the first point where origin + fraction translation, 0 <= fraction <= max_fraction, meets the primitive. For
/// an origin inside or on the surface reports fraction 0 and the normal opposite to the ray (zero for a ray of no
/// length). Writes `hit` only if it returns true. Rays hit shapes from outside only. With `back_faces` they hit
/// triangles from behind too, whose normals are then turned round. Of triangles hit at once the lowest is reported.
/// Units:  origin and translation [m], world frame.
/// Error:  of the point hit, along the ray: fixed 4 raw units, float and double 4 ulp of the largest coordinate, over
///         the cosine of incidence; and half a step of the fraction times the ray's length (0.8 mm for 100 m in
///         Q16.16). Rays that pass an edge closer than that may go either way.
/// Limits: origin within Limits<S>::position(), translation within twice that.
template <class S>
bool ray_cast(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> origin,
              Vec3<S> translation, S max_fraction, RayHit<S>& hit, bool back_faces = false);
/// Reports all hits: every triangle that is entered, those on both sides of an edge too; one hit of another shape.
template <class S>
void ray_cast_all(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> origin,
                  Vec3<S> translation, const RayReach<S>& reach, const RayHitTaker<S>& taker);

#define ISO_RAY_CAST_OF(extern, S)                                                                              \
  extern template bool ray_cast<S>(ShapeView<S>, const Transform<S>&, Vec3<S>, Vec3<S>, S, RayHit<S>&, bool);   \
  extern template void ray_cast_all<S>(ShapeView<S>, const Transform<S>&, Vec3<S>, Vec3<S>, const RayReach<S>&, \
                                       const RayHitTaker<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_RAY_CAST_OF)

}  // namespace isostep
