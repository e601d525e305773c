// Soft step, the default solver: contacts found once a step, solved over sub-steps as soft constraints, then relaxed.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/colouring.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/geometry/limits.hpp"

namespace isostep {

/// Acceleration asked for by forces, for this step alone.
template <class S> struct Acceleration {
  Vec3<S> linear;   // [m/s^2]
  Vec3<S> angular;  // [rad/s^2]
};

/// No body turns by more than a radian about an axis in a sub-step [rad/s]: beyond, a turn is no longer small.
template <class S> ISO_INLINE constexpr Velocity<S> spin_limit(std::int32_t rate) {
  return convert<Velocity<S>>(min(Limits<S>::spin(), S(rate)));
}

/// What the solver is given: awake bodies in order, the contacts between them and their joints in canonical order.
template <class S> struct SolverInput {
  std::span<BodyState<S>> states;
  std::span<const BodyProperties<S>> properties;
  std::span<const Acceleration<S>> accelerations;  // per body, or empty
  std::span<Contact<S>> contacts;
  std::span<const ContactGeometry<S>> geometry;
  std::span<Velocity<S>> step_impulses;  // [m/s] per contact, of the whole step: filled by store_impulses
  std::span<JointConstraint<S>> joints;  // prepared
  Vec3<S> gravity;                       // [m/s^2]
  std::int32_t hz;                       // [1/s] steps
  std::int32_t substeps;
};

/// Source:  Catto 2024, Solver2D ("Soft Step"); Macklin et al. 2019, Small Steps in Physics Simulation.
/// Order:   the calls below, once each a step. Nothing is kept from step to step but memory.
template <class S> class SoftStep {
 public:
  void gather_bodies(const SolverInput<S>& input);
  void colour_constraints(const SolverInput<S>& input, const ContactKernels<S>& wide);
  void prepare(const SolverInput<S>& input);
  void solve_substeps(const SolverInput<S>& input, const TreeKernels<S>& trees);
  void restitute(const SolverInput<S>& input);
  void store_impulses(const SolverInput<S>& input);

  SolverBodies<S>& bodies() { return bodies_; }
  const SolverBodies<S>& bodies() const { return bodies_; }

 private:
  /// Consecutive entries of order_ that one kernel solves.
  struct Run {
    const ContactKernels<S>* kernels;
    std::uint32_t variant;
    std::uint32_t first, count;  // in order_
    std::uint32_t first_block, blocks;
    std::size_t offset;  // [bytes] in memory_
  };
  struct alignas(64) Chunk {
    unsigned char bytes[64];
  };

  BlockRun<S> blocks_of(const Run& run);
  void add_run(const ContactKernels<S>& kernels, std::uint32_t variant, std::uint32_t first, std::uint32_t count);
  void integrate_velocities(const SolverInput<S>& input);
  void integrate_positions(const SolverInput<S>& input);

  SolverBodies<S> bodies_;
  JointTrees<S> joint_trees_;
  std::vector<Vec3<S>> inertia_;  // [1] principal moments over the largest, where the gyroscopic term acts
  Colouring colouring_;
  std::vector<std::uint32_t> bucket_;  // of each contact: colour * variants + variant
  std::vector<std::uint32_t> bucket_ends_;
  std::vector<std::uint32_t> order_;  // contacts, grouped
  std::vector<Run> runs_;
  std::vector<Chunk> memory_;
  std::vector<BlockBodies> block_bodies_;
  std::uint32_t block_count_ = 0;
  std::size_t memory_bytes_ = 0;
};

}  // namespace isostep
