// Fault: why a world refused something; one list for all kinds of worlds.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Identical on every peer.
enum class Fault : std::uint32_t {
  none,
  stale_id,      // the id names nothing any more
  not_finite,    // NaN or infinity where a number is expected
  out_of_range,  // beyond the scalar's limits
  bad_shape,     // sizes, normals or parts that make no shape
  bad_mass,      // mass or inertia that nothing can have
  bad_argument,  // a flag, count or enumerator that is not one
  shape_in_use,  // bodies still name the shape, or particles the material
  not_dynamic,   // forces on what no force moves
};
const char* fault_text(Fault fault);

}  // namespace isostep
