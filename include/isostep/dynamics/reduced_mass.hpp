// The mass behind impulses that are counted as velocity changes of a pair.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solver_body.hpp"

namespace isostep {

/// [kg] Returns m_a m_b / (m_a + m_b), where 0 is an unmoved body. 0 if neither moves.
template <class S> ISO_INLINE S reduced_mass(S mass_a, S mass_b) {
  return mass_b > S(0) ? mass_share(mass_a, mass_b).b * mass_b : mass_a;
}

}  // namespace isostep
