// Time of impact of a convex core that moves and turns with a plane at rest.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/time_of_impact.hpp"

namespace isostep {

/// A half-space: all points p with normal . (p - point) <= 0.
template <class S> struct SolidPlane {
  Vec3<Unit<S>> normal;  // [1]
  Vec3<S> point;         // [m] of the surface, within Limits<S>::position() of the core
};

/// time_of_impact() against a plane: takes the bound along the plane's normal, which is given and needs no search. The
/// normal of the result points from the core to the plane. Its points are zero, except `on_a` for a touch at the start:
/// the lowest point of the core.
template <class S>
TimeOfImpact<S> plane_impact(const ConvexCore<S>& core, const CoreMotion<S>& motion, const SolidPlane<S>& plane,
                             S target);

#define ISO_PLANE_IMPACT_OF(extern, S) \
  extern template TimeOfImpact<S> plane_impact<S>(const ConvexCore<S>&, const CoreMotion<S>&, const SolidPlane<S>&, S);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PLANE_IMPACT_OF)

}  // namespace isostep
