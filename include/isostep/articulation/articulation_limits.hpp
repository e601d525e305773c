// The range of an articulation's step, in the tree's own units, and why products within it fit 64 bits of fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/scalar.hpp"

namespace isostep::detail {

// The unit of length is such that the tree reaches 2^5 to 2^6 of them, the unit of mass is the tree. So inertias are
// below 2^12, and below 2^18 with what the laws of joints add. Forces and torques are held below 2^30, half of Q32.32,
// wherever they are summed (headroom.hpp).
//   spin^2 reach^2     2^16 2^12: gyroscopic forces and centrifugal ones fit.
//   turn reach         2^22 2^6: the acceleration of an end; a sum of three fits.

template <class S> inline constexpr S kMostSpin = S(256);            // [rad/s] of a link, along an axis of the world
template <class S> inline constexpr S kMostTurn = S(0x1p22);         // [rad/s^2]
template <class S> inline constexpr S kMostSlide = S(0x1p28);        // [units/s^2]
template <class S> inline constexpr S kMostSlideSpeed = S(0x1p12);   // [units/s] of a slider
template <class S> inline constexpr S kMostSlideWay = S(0x1p24);     // [units] of a slider on the base
template <class S> inline constexpr S kMostCoefficient = S(0x1p16);  // armature, h damping, h^2 stiffness
template <class S> inline constexpr S kMostLoad = S(0x1p29);         // [N] [N m] of one link

template <class S> inline constexpr S kLeastCone = S(0.05);  // [rad]
template <class S> inline constexpr S kMostCone = S(2.8);    // [rad] beyond, a cone's axis is hard to tell

/// [rad/s], [m/s] The greatest speed at which a joint beyond a limit comes back, a quarter of the way a sub-step.
template <class S> inline constexpr S kReturnSpeed = S(2);

template <class S> inline constexpr S kHalfTurn = S(3.14159265358979323846);  // [rad]

}  // namespace isostep::detail
