// A thrown mechanism is watched: what is outside of its room, how far its joints come apart, what energy it gains.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "random/joint_hold.hpp"
#include "random/thrown.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {

struct ThrownFindings {
  int outside = 0;     // bodies whose middle was beyond the walls' middle, or beyond a surface, once or more
  double apart = 0;    // [m] worst of what joints hold together, over the run
  double later = 0;    // [m] the same from a second after the throw on
  double gained = 0;   // [1] of the energy that it was thrown with
  double slowest = 1;  // [1] least speed of the thrown, of that of the throw: it hit something
  int mended = 0;      // steps that had to mend more than speeds beyond their limits
};

template <class S> ThrownFindings throw_mechanism(std::uint64_t seed, SolverName solver, int frames = 120) {
  ThrownMechanism<S> thrown(seed, solver);
  World<S>& w = thrown.world;
  constexpr double kSurface = 0.01;  // [m] as deep as a middle may be in a surface while contacts press
  const double edge = thrown.kHalf + (thrown.room == RoomKind::sheet ? kSurface : thrown.wall);
  const double start = scenes::measure_energy(w).total();
  const double motion = scenes::measure_energy(w).kinetic;
  ThrownFindings found;
  std::vector<bool> outside(thrown.bodies.size(), false);
  for (int frame = 1; frame <= frames; ++frame) {
    StepReport report = w.step();
    report.clamped_speed = 0;
    found.mended += report.clean() ? 0 : 1;
    found.gained = std::max(found.gained, (scenes::measure_energy(w).total() - start) / motion);
    double fastest = 0;
    for (std::size_t i = 0; i < thrown.bodies.size(); ++i) {
      const D3 at = real(w.center_of_mass(thrown.bodies[i]));
      fastest = std::max(fastest, length(real(w.velocity(thrown.bodies[i]))));
      if (!(max_abs(at) < edge)) outside[i] = true;
    }
    found.slowest = std::min(found.slowest, fastest / thrown.speed);
    for (const JointId joint : thrown.joints) {
      const double apart = hold_of(w, joint).place;
      found.apart = std::max(found.apart, apart);
      if (frame >= 60) found.later = std::max(found.later, apart);
    }
  }
  for (const bool one : outside) found.outside += one ? 1 : 0;
  return found;
}

}  // namespace isostep::test
