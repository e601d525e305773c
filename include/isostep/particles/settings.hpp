// The settings of a particle world, and the names of its methods.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// The method by which velocities and positions follow from forces. One order of updates everywhere: forces, then
/// velocities, then positions, then constraints; explicit Euler alone moves first and then accelerates (the book's
/// order). A warm step asks for no memory but with implicit_euler, where a large network makes Eigen ask for its
/// working rows in every sub-step, and where a spring yields or a particle expires while a snapshot shares its list:
/// that is copied first.
enum class Integrator : std::uint32_t { explicit_euler, semi_implicit_euler, velocity_verlet, rk4, implicit_euler };
inline constexpr const char* kIntegratorNames[] = {"explicit_euler", "semi_implicit_euler", "velocity_verlet", "rk4",
                                                   "implicit_euler"};
inline constexpr std::uint32_t kIntegrators = 5;

/// The method that holds contacts, cables and rods.
///   soft_step    impulses over sub-steps as damped springs, then relaxed (the rigid world's method)
///   worst_first  after the integration, the fastest closing first (Millington, ch. 7)
enum class ParticleSolver : std::uint32_t { soft_step, worst_first };
inline constexpr const char* kParticleSolverNames[] = {"soft_step", "worst_first"};
inline constexpr std::uint32_t kParticleSolvers = 2;

/// fixed          every sub-step has one length
/// time_division  a sub-step ends at the first contact within it, which is resolved before the rest goes on, so that
///                nothing tunnels (Millington, ch. 7.4.2); the sub-step of the whole world, so what is far off shows
enum class Stepping : std::uint32_t { fixed, time_division };
inline constexpr const char* kSteppingNames[] = {"fixed", "time_division"};
inline constexpr std::uint32_t kSteppings = 2;

/// The most sub-steps a second that every scalar can count and divide by.
inline constexpr std::int32_t kMaxParticleRate = 16384;

/// [1] The most pairs that a search may find, whatever the settings: 4 GB of contacts.
inline constexpr std::uint32_t kMostParticlePairs = 1u << 24;

/// Rates are whole numbers, so that the time step is exact and the same everywhere.
template <class S> struct ParticleSettings {
  std::int32_t hz = 60;                    // [1/s] steps, 10..1000
  std::int32_t substeps = 4;               // per step, 1..64, hz * substeps <= kMaxParticleRate
  Vec3<S> gravity = {S(0), S(-10), S(0)};  // [m/s^2]
  Integrator integrator = Integrator::semi_implicit_euler;
  ParticleSolver solver = ParticleSolver::soft_step;
  Stepping stepping = Stepping::fixed;
  std::uint32_t iterations = 0;  // of worst_first a sub-step, of all; 0: two a constraint, each island its own
  // Bounds of what a crowd may cost; ParticleReport says what was over, and it is over alike everywhere.
  std::uint32_t pairs = 0;  // that a step's search may find, up to kMostParticlePairs; 0: 64 a particle, at least 2^21
  std::uint32_t looks = 0;  // at constraints, of worst_first a step; 0: 2^22 and 2048 a particle

  friend bool operator==(const ParticleSettings&, const ParticleSettings&) = default;
  ISO_FIELDS(hz, substeps, gravity, integrator, solver, stepping, iterations, pairs, looks)
};

}  // namespace isostep
