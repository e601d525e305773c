// The yardstick of free flight: what anybody writes for float, compiled once as compilers like it and once as ours.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep::bench {

/// Arrays of `count` floats. No clamps, no pinned ones, one material, no report of what leaves the range.
struct PlainFlight {
  float *x, *y, *z, *vx, *vy, *vz;  // [m] [m/s]
  const float* inverse_mass;        // [1/kg]
  int count, substeps;
  float h;                            // [s]
  float gravity;                      // [m/s^2] along y
  float linear_drag, quadratic_drag;  // [N s/m] [N s^2/m^2]
  float keep;                         // [1] of the velocity, a sub-step
};

/// Steps with the compiler's own flags for speed: -O3, its vectoriser, no errno from square roots.
void step_fast(const PlainFlight& flight);
/// Steps with the library's exact flags.
void step_exact(const PlainFlight& flight);

}  // namespace isostep::bench
