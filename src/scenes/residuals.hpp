// How far the contacts of a world are from the laws of dry contact: Signorini's, Coulomb's, and of most dissipation.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/world/world.hpp"

namespace isostep::scenes {

/// Source:  Le Lidec et al. 2023, Contact Models in Robotics: a Comparative Analysis, sections II and IV; as distances
///          from the solution set, which need no scale of their own.
/// Symbols: l = normal impulse, f = friction impulse on b, both as the change of the pair's relative speed [m/s];
///          n, t = relative speed along the normal and across it; mu = friction.
/// Each is the root mean square over the contacts, after a step, of the last sub-step's impulses and the velocities
/// that it left. 0: no contact, or all of them obey.
struct ContactResiduals {
  double signorini = 0;    // [m/s] min(l, n) of each point: it pushes, or it opens, never both
  double coulomb = 0;      // [m/s] by which f is beyond mu l
  double dissipation = 0;  // [m/s] from f to the friction within mu l that resists t most
  std::uint32_t contacts = 0;
};

/// Counts awake contacts but those of moving surfaces. Friction is that of the bodies' materials.
template <class S> ContactResiduals measure_residuals(const World<S>& world);

#define ISO_EXTERN(S) extern template ContactResiduals measure_residuals<S>(const World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
