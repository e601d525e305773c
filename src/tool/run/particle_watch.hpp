// The observations of `run` on a world of particles, beside times and hashes.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>

#include "isostep/particles/particle_state.hpp"
#include "isostep/scalar/text.hpp"
#include "run_report.hpp"
#include "run_watch.hpp"
#include "scenes/particles/particle_measure.hpp"

namespace isostep::tool {

template <class S> class ParticleWatch {
 public:
  using Report = ParticleRunReport;

  explicit ParticleWatch(const ParticleWorld<S>& world) {
    found_.energy_start = scenes::measure_energy(world).total();
    observe(world);
  }
  void stepped(const ParticleWorld<S>& world, const ParticleReport& step, int, bool) {
    found_.faults += std::uint64_t{step.clamped_speed} + step.clamped_force + step.clamped_position + step.stopped +
                     step.undivided + step.unsolved + step.lost_pairs + step.spent;
    found_.unresolved += step.unresolved;
    observe(world);
  }
  ParticleRunReport report(const ParticleWorld<S>& world) const {
    ParticleRunReport report = found_;
    const ParticleSettings<S>& settings = world.settings();
    report.solver = kParticleSolverNames[static_cast<std::uint32_t>(settings.solver)];
    report.integrator = kIntegratorNames[static_cast<std::uint32_t>(settings.integrator)];
    report.stepping = kSteppingNames[static_cast<std::uint32_t>(settings.stepping)];
    report.simd = world.simd_name();
    report.substeps = settings.substeps;
    report.counts = world.counts();
    report.penetration_max = scenes::largest_overlap(world);
    report.speed_max = scenes::largest_speed(world);
    report.energy_end = scenes::measure_energy(world).total();
    return report;
  }

 private:
  void observe(const ParticleWorld<S>& world) {
    if (!world.state().links.all().empty())
      found_.link_error_max = std::max(found_.link_error_max, scenes::largest_link_error(world));
  }

  ParticleRunReport found_;
};
template <class S> ParticleWatch<S> watch_of(const ParticleWorld<S>& world) { return ParticleWatch<S>(world); }

/// Particles by slot.
template <class S> std::string dump_of(const ParticleWorld<S>& world) {
  std::string text = "{\"particles\": [";
  bool first = true;
  for (const ParticleId particle : world.particles()) {
    text += (first ? "\n  {\"slot\": " : ",\n  {\"slot\": ") + std::to_string(particle.slot);
    text += ", \"position\": " + detail::list(world.position(particle));
    text += ", \"velocity\": " + detail::list(world.velocity(particle)) + "}";
    first = false;
  }
  return text + "]}\n";
}

}  // namespace isostep::tool
