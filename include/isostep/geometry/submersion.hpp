// Submersion<S>: the part of a solid below a plane and its middle, as buoyancy needs them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// The submerged part of a homogeneous solid.
template <class S> struct Submersion {
  Unit<S> share;   // [1] 0 to 1, of its volume
  Vec3<S> centre;  // [m] of the volume of that part, in the solid's frame; of nothing: of the solid
};

/// Returns the part of a solid where dot(up, x) < level, all in the solid's frame: `up` [1] of unit length, `level`
/// [m].
/// Method:  what has flat faces by the tetrahedra between its faces, cut at the plane, and a point of the plane, which
///          the cut itself adds nothing to (Catto 2006, Exact Buoyancy for Polyhedra, Game Programming Gems 6, 2.5); a
///          sphere in closed form; cylinders, cones and capsules by ten slices across the axis between every two
///          places where the way the plane cuts them changes (Gauss-Legendre over an angle, in which slices are
///          smooth). Everything is measured in the solid's own half widths, so thin solids keep their digits.
/// Rounded hulls are what mass_properties() takes them for: the core, stretched. Surfaces and half-spaces, which do not
/// move, have no share.
/// Error:   of the share, 1e-12 (double), 1e-9 (Q32.32), 2e-6 (float), 4e-5 (Q16.16, whose level is rounded); sliced
///          solids at least 1e-7. Of the centre, times the share, twice that of the solid's size:
///          tests/unit/geometry/submersion_test.cpp.
/// Limits:  shapes pass validate(); |level| up to twice Limits<S>::position().
template <class S>
Submersion<S> submersion(std::type_identity_t<ShapeView<S>> solid, Vec3<Unit<S>> up, std::type_identity_t<S> level);

#define ISO_SUBMERSION_OF(extern, S) extern template Submersion<S> submersion<S>(ShapeView<S>, Vec3<Unit<S>>, S);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SUBMERSION_OF)

}  // namespace isostep
