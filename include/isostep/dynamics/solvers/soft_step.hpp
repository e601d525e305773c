// Soft step, the default solver: contacts found once a step, solved over sub-steps as soft constraints, then relaxed.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/task_runner.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/colouring.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/dynamics/solvers/pass_plan.hpp"
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
  TaskRunner runner;  // changes no bit
};

/// Source:  Catto 2024, Solver2D ("Soft Step"); Macklin et al. 2019, Small Steps in Physics Simulation.
/// Order:   the calls below, once each a step. Those from `prepare` on say what is to be done; `run` does it, and may
///          be called after each of them or once in the end. Nothing is kept from step to step but memory.
template <class S> class SoftStep {
 public:
  void gather_bodies(const SolverInput<S>& input);
  void colour_constraints(const SolverInput<S>& input, const ContactKernels<S>& wide);
  void prepare();
  void solve_substeps(const SolverInput<S>& input, const TreeKernels<S>& trees);
  void restitute(const SolverInput<S>& input);
  void store_impulses();
  void run(const SolverInput<S>& input);

  SolverBodies<S>& bodies() { return bodies_; }
  const SolverBodies<S>& bodies() const { return bodies_; }

 private:
  /// Consecutive entries of order_ that one kernel solves.
  struct Run {
    const ContactKernels<S>* kernels;
    std::uint32_t variant, colour;
    std::uint32_t first, count;  // in order_
    std::uint32_t first_block, blocks;
    std::size_t offset;  // [bytes] in memory_
  };
  /// Of order_.
  struct Contacts {
    std::uint32_t first;
    std::int32_t count;
  };
  struct alignas(64) Chunk {
    unsigned char bytes[64];
  };
  /// What the pieces of one stage do.
  enum class Work : std::uint32_t {
    prepare,
    integrate_velocities,
    warm_start_joints,
    warm_start,
    solve_joints,
    solve,
    integrate_positions,
    relax_joints,
    relax,
    store_joints,
    restitute,
    store,
    store_bodies,
  };
  struct Stage {
    Work work;
    std::uint32_t of_plan;  // the stage of contact_plan_ or bodies' pieces
  };
  /// What every piece reads.
  struct Job {
    SoftStep* solver;
    const SolverInput<S>& input;
    ContactPass<S> pass;
    JointStep<S> joints;
  };

  // soft_step.inl
  void add_run(const ContactKernels<S>& kernels, std::uint32_t variant, std::uint32_t colour, std::uint32_t first,
               std::uint32_t count);
  void plan_passes(const TaskRunner& runner);
  std::size_t place_of(const Run& run, std::uint32_t block) const;
  static Contacts contacts_of(const Run& run, const PassPlan::Slice& slice);
  BlockRun<S> blocks_of(const PassPlan::Slice& slice);
  void prepare_slice(const SolverInput<S>& input, const PassPlan::Slice& slice);
  void store_slice(const SolverInput<S>& input, const PassPlan::Slice& slice);

  // soft_step_stages.inl
  void add_stage(Work work, std::uint32_t of_plan, std::uint32_t pieces);
  void add_stages(Work work, const PassPlan& plan);
  static void do_piece(void* job, std::uint32_t stage, std::uint32_t piece);
  void do_slice(const Job& job, Work work, const PassPlan::Slice& slice);
  void do_joints(const Job& job, Work work, std::uint32_t piece);
  void do_bodies(const Job& job, Work work, std::uint32_t piece);
  void integrate_velocities(const SolverInput<S>& input, std::size_t first, std::size_t end);
  void integrate_positions(const SolverInput<S>& input, std::size_t first, std::size_t end);

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
  TaskRunner runner_;  // the input's, or none where the work is too little to share
  PassPlan colours_;   // colour after colour
  PassPlan all_;       // every block at once, for what touches no body
  std::uint32_t body_pieces_ = 1;
  std::vector<Stage> stages_;
  std::vector<std::uint32_t> pieces_;  // of each stage
};

}  // namespace isostep
