// The common part of the generators of worlds with particles: how methods are drawn, what energy there is, and its law.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ostream>

#include "laws/particle_laws.hpp"
#include "random/asked.hpp"
#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {

/// Every integrator that keeps energy, every solver and stepping.
template <class S> void draw_methods(Chance& chance, ParticleSettings<S>& s) {
  constexpr Integrator kIntegrators[] = {Integrator::semi_implicit_euler, Integrator::velocity_verlet, Integrator::rk4,
                                         Integrator::implicit_euler};
  s.integrator = kIntegrators[chance.below(4)];
  s.solver = chance.one_in(2) ? ParticleSolver::soft_step : ParticleSolver::worst_first;
  s.stepping = s.solver == ParticleSolver::worst_first && chance.one_in(2) ? Stepping::time_division : Stepping::fixed;
}
template <class S> void tell_methods(std::ostream& out, const ParticleSettings<S>& s) {
  out << kIntegratorNames[static_cast<int>(s.integrator)] << " " << kParticleSolverNames[static_cast<int>(s.solver)]
      << " " << kSteppingNames[static_cast<int>(s.stepping)];
}

/// The step met no limit.
inline bool keeps_limits(const ParticleReport& report) {
  return report.stopped + report.clamped_speed + report.clamped_position == 0;
}

/// Particles with their masses [kg], 0 for pinned ones, and the springs between them.
template <class S> struct ParticleSystem {
  std::vector<ParticleId> ids;
  std::vector<double> masses;
  std::vector<Spring<S>> springs;

  void add(ParticleWorld<S>& w, const ParticleDefinition<S>& definition) {
    ids.push_back(w.create(definition));
    EXPECT_TRUE(ids.back());
    masses.push_back(definition.pinned ? 0 : to_double(definition.mass));
  }
  /// [1/kg] The inverse mass of the particle that was added as the i-th.
  double inverse_mass(std::size_t i) const { return masses[i] > 0 ? 1 / masses[i] : 0; }
  /// [J] The energy of motion, of height above 0, and in springs.
  double energy(const ParticleWorld<S>& w) const {
    const double gravity = to_double(w.settings().gravity.y);
    double sum = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const D3 v = real(w.state().velocity[ids[i].slot]);
      sum += masses[i] * (dot(v, v) / 2 - gravity * to_double(w.position(ids[i]).y));
    }
    for (const Spring<S>& spring : springs) {
      const D3 b = spring.b ? real(w.position(spring.b)) : real(spring.anchor);
      const double longer = length(real(w.position(spring.a)) - b) - to_double(spring.rest_length);
      if (spring.type != SpringType::bungee || longer > 0) sum += to_double(spring.stiffness) * longer * longer / 2;
    }
    return sum;
  }
};

/// Five seconds of each of so many worlds. A world has start(), most() and energy() [J], steps(seconds), telling(), and
/// step(), which is false where a limit was met. `shows(world, changed)`: whether it could have gained anything.
template <class RandomWorld, class Shows> void expect_no_gain(std::uint64_t worlds, const Shows& shows) {
  std::uint64_t shown = 0;
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    RandomWorld world(seed);
    double most = world.start();
    const int steps = world.steps(5);
    bool changed = false;
    for (int i = 0; i < steps; ++i) {
      ASSERT_TRUE(world.step()) << world.telling();
      const double now = world.energy();
      changed = changed || now != most;
      most = std::max(most, now);
    }
    shown += shows(world, changed);
    EXPECT_LE(most, world.most()) << world.telling();
  }
  EXPECT_GT(shown, worlds / 2) << "worlds in which nothing happens show nothing";
}

}  // namespace isostep::test
