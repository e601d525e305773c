// Mass, centre and specific inverse inertia of shapes: what a body needs to know of its geometry.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Inertia is kept as kappa = mass * inverse inertia. It depends on the geometry alone and is near 1 / size^2, so it
/// fits fixed point where 1/I of a heavy body does not, and a body's mass can change without it.
template <class S> struct MassProperties {
  S mass;                   // [kg]
  Vec3<S> centre;           // [m] centre of mass, body frame
  Vec3<S> kappa;            // [1/m^2] about the centre along the principal axes
  Quat<Unit<S>> principal;  // rotates from the principal frame to the body frame; w >= 0 for several children
};

/// Returns the properties of homogeneous children; overlaps count twice. One child whose frame is its own principal one
/// keeps it: centre and principal are its pose, kappa its closed form. Others are added by the parallel-axis theorem
/// and diagonalised by rotations from the body axes, none above 45 degrees, so a compound that is already principal
/// keeps them.
/// Units:  density [kg/m^3] > 0.
/// Limits: shapes pass validate(). Mass saturates at Limits<S>::mass() and is at least one resolution step. No
///         children, or a half-space among them: mass 0 and kappa 0, a body that nothing moves.
/// Error:  of kappa, relative, beside its rounding to S: one child 1e-5 (Q16.16, 0.1 m .. 10 m), 1e-10 (Q32.32), 4e-7,
///         1e-14 (float, double, 0.02 m .. 20 m); several 1e-4, 2e-9, 1e-6, 1e-13. Measured in
///         tests/unit/geometry/mass_properties_test.cpp.
template <class S>
MassProperties<S> mass_properties(std::span<const Child<S>> children, S density, Contents<S> contents = {});

namespace detail {
template <class S> ISO_INLINE constexpr S kappa_of_axis(S mass, S inertia) {
  return inertia > S(0) ? divide_to<S>(mass, inertia) : S(0);
}
}  // namespace detail

/// Takes a user's own numbers: inertia [kg m^2] about the centre along the body axes. A component that is not positive
/// means a body that does not turn about that axis (kappa 0).
template <class S>
ISO_INLINE constexpr MassProperties<S> from_mass_and_inertia(S mass, Vec3<S> inertia, Vec3<S> centre) {
  const Vec3<S> kappa = {detail::kappa_of_axis(mass, inertia.x), detail::kappa_of_axis(mass, inertia.y),
                         detail::kappa_of_axis(mass, inertia.z)};
  return {mass, centre, kappa, Quat<Unit<S>>::identity()};
}

/// Gives the shape a user's own mass [kg]: inertia scales along, so kappa stays.
template <class S> ISO_INLINE constexpr MassProperties<S> with_mass(MassProperties<S> properties, S mass) {
  properties.mass = mass;
  return properties;
}

#define ISO_MASS_PROPERTIES_OF(extern, S) \
  extern template MassProperties<S> mass_properties<S>(std::span<const Child<S>>, S, Contents<S>);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_MASS_PROPERTIES_OF)

}  // namespace isostep
