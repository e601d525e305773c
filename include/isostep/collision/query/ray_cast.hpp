// Rays against one primitive.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

template <class S> struct RayHit {
  S fraction;            // [1] of the translation, 0 ... max_fraction
  Vec3<Unit<S>> normal;  // [1] of the surface, world frame, against the ray
};

/// The first point where origin + fraction translation, 0 <= fraction <= max_fraction, meets the primitive. An origin
/// inside or on the surface reports fraction 0 and the normal opposite to the ray (zero for a ray of no length).
/// `hit` is written only when the result is true. Surfaces are hit from outside alone.
/// Units:  origin and translation [m], world frame.
/// Error:  of the point hit, along the ray: fixed 4 raw units, float and double 4 ulp of the largest coordinate, over
/// the
///         cosine of incidence; and half a step of the fraction times the ray's length (0.8 mm for 100 m in Q16.16).
///         Rays that pass an edge closer than that may go either way.
/// Limits: origin within Limits<S>::position(), translation within twice that.
template <class S>
bool ray_cast(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> origin,
              Vec3<S> translation, S max_fraction, RayHit<S>& hit);

#define ISO_EXTERN(S) \
  extern template bool ray_cast<S>(ShapeView<S>, const Transform<S>&, Vec3<S>, Vec3<S>, S, RayHit<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
