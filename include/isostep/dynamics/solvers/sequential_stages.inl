// The sub-steps of sequential.hpp as stages of pieces: what threads do side by side, and in which order.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/body_rows.inl"
#include "isostep/dynamics/solvers/impacts.inl"
#include "isostep/dynamics/solvers/sequential.hpp"

namespace isostep {

namespace detail {

template <class S> ContactPass<S> contact_pass(const Schedule<S>& schedule) {
  const S rate = S(schedule.rate);
  // A gap wider than a sub-step covers at 64 m/s counts as that: nothing so far apart closes within the sub-step. Loads
  // beyond a 64th of the format (32 m/s for Q16.16) count as that: times friction and the cone's slope they still fit.
  return {schedule.contact_softness, rate, kPushSpeed<S>, divide_to<Velocity<S>>(S(64), rate),
          highest<Velocity<S>>() * Velocity<S>(1.0 / 64)};
}
}  // namespace detail

template <class S>
void Sequential<S>::add_stage(Work work, std::uint32_t pieces, const PassPlan* plan, std::uint32_t of_plan) {
  stages_.push_back({work, plan, of_plan});
  pieces_.push_back(pieces);
}
template <class S> void Sequential<S>::add_stages(Work work, const PassPlan& plan) {
  for (std::uint32_t i = 0; i < plan.stages().size(); ++i) add_stage(work, plan.stages()[i], &plan, i);
}
/// Adds a pass over contacts, followed by the relief of those that give way.
template <class S> void Sequential<S>::add_pass(Work work, const PassPlan& plan, const StepContext<S>& context) {
  add_stages(work, plan);
  if (!context.responses.empty()) add_stage(Work::relieve, 1);
}

template <class S> void Sequential<S>::add_mechanisms(Work work, const StepContext<S>& context) {
  if (context.mechanisms.any()) add_stage(work, 1);
}

template <class S> void Sequential<S>::run(const StepContext<S>& context) {
  const S rate = S(schedule_.rate);
  Job job = {this,
             context,
             detail::contact_pass(schedule_),
             {context.states.data(), &bodies_.rows(), rate, divide_to<Step<S>>(S(1), rate), schedule_.joint_softness,
              rapid_angular_speed<S>(context.hz), angular_speed_to_follow<S>(schedule_.rate)}};
  run_stages(runner_, pieces_, &Sequential::do_piece, &job);
  stages_.clear();
  pieces_.clear();
}

template <class S> void Sequential<S>::do_piece(void* data, std::uint32_t stage, std::uint32_t piece) {
  const Job& job = *static_cast<const Job*>(data);
  Sequential& solver = *job.solver;
  const Stage& what = solver.stages_[stage];
  switch (what.work) {
    case Work::group: return solver.group(job.context, piece);
    case Work::gather:
    case Work::integrate_velocities:
    case Work::integrate_positions:
    case Work::store_bodies: return solver.do_bodies(job, what.work, piece);
    case Work::begin_contacts: solver.carry(job.context); return solver.forget_impulses(job.context);
    case Work::follow: return solver.follow(job.context);
    case Work::respond: return solver.respond(job.context);
    case Work::hold_energy: return solver.bodies_.hold_energy(job.context);
    case Work::relieve: return solver.relieve(job.context);
    case Work::add_joint_impulses: return solver.joints_.add_impulses(job.context);
    case Work::bounce: return solver.impacts_.bounce(job.context, solver.bodies_);
    case Work::renew_forces: return solver.bodies_.renew_forces(job.context);
    case Work::place_mechanisms:
    case Work::solve_mechanisms:
    case Work::close_mechanisms:
    case Work::relax_mechanisms:
    case Work::end_mechanisms: return solver.do_mechanisms(job.context, what.work);
    case Work::warm_start_joints:
    case Work::solve_joints:
    case Work::relax_joints:
    case Work::store_joints: return solver.do_joints(job, what.work, piece);
    default: break;
  }
  for (const PassPlan::Slice& slice : what.plan->piece(what.of_plan, piece)) solver.do_slice(job, what.work, slice);
}

template <class S> void Sequential<S>::do_slice(const Job& job, Work work, const PassPlan::Slice& slice) {
  const Run& run = runs_[slice.run];
  switch (work) {
    case Work::prepare: return prepare_slice(job.context, slice);
    case Work::warm_start: return run.kernels->warm_start[run.variant](blocks_of(slice));
    case Work::solve: return run.kernels->solve[run.variant](blocks_of(slice), job.pass);
    case Work::relax: return run.kernels->relax[run.variant](blocks_of(slice), job.pass);
    case Work::store: return store_slice(job.context, slice);
    default: return;
  }
}

template <class S> void Sequential<S>::do_bodies(const Job& job, Work work, std::uint32_t piece) {
  const std::size_t count = job.context.states.size();
  const std::size_t first = count * piece / body_pieces_, end = count * (piece + 1) / body_pieces_;
  switch (work) {
    case Work::gather: any_followed_[piece] = bodies_.gather_range(job.context, first, end); return;
    case Work::integrate_velocities: return bodies_.integrate_velocities(job.context, first, end);
    case Work::integrate_positions: any_followed_[piece] = bodies_.integrate_positions(job.context, first, end); return;
    default: return bodies_.store(job.context, first, end);
  }
}

/// The first pieces group contacts and bodies, the others prepare joints.
template <class S> void Sequential<S>::group(const StepContext<S>& context, std::uint32_t piece) {
  if (piece == 0) return colour_contacts(context);
  if (piece == 1) return bodies_.bind(context, schedule_.relaxes);
  const std::size_t count = joints_.size(), part = piece - kGroupers;
  joints_.prepare(context, bodies_.rows(), count * part / joint_pieces_, count * (part + 1) / joint_pieces_);
}
template <class S> void Sequential<S>::do_joints(const Job& job, Work work, std::uint32_t piece) {
  const std::uint32_t count = joint_trees_.batch_count(), pieces = min(count, kMaxPieces);
  for (std::uint32_t i = count * piece / pieces; i < count * (piece + 1) / pieces; ++i) {
    if (work == Work::warm_start_joints) joint_trees_.warm_start(i, joints_.all(), job.joints);
    else if (work == Work::store_joints) joint_trees_.store(i, joints_.all());
    else joint_trees_.solve(i, job.joints, work == Work::relax_joints);
  }
}

/// Returns how often a pass solves mechanisms and joints: a coupling feels a motor or a brake in the same sub-step.
template <class S> std::int32_t Sequential<S>::rounds_of(const StepContext<S>& context) const {
  return context.mechanisms.couples ? max(1, kMechanismSweeps / schedule_.passes) : 1;
}
template <class S> void Sequential<S>::do_mechanisms(const StepContext<S>& context, Work work) {
  SolverBodies<S>& bodies = bodies_.rows();
  const MechanismRows<S>& mechanisms = context.mechanisms;
  switch (work) {
    case Work::place_mechanisms: return mechanisms.place(bodies, schedule_.rate);
    case Work::solve_mechanisms:
      return mechanisms.solve(bodies, max(1, kMechanismSweeps / (schedule_.passes * rounds_of(context))));
    case Work::close_mechanisms: return mechanisms.close(bodies);
    case Work::relax_mechanisms: return mechanisms.relax(bodies);
    default: return mechanisms.end();
  }
}

template <class S> void Sequential<S>::prepare(const StepContext<S>& context) {
  memory_.resize(memory_bytes_);
  block_bodies_.resize(block_count_ + 1);
  find_lanes(context);
  add_stages(Work::prepare, all_);
  if (!context.responses.empty()) add_stage(Work::respond, 1);
  if (context.watched) run(context);
}

template <class S> void Sequential<S>::solve_substeps(const StepContext<S>& context) {
  joint_trees_.plan(joints_.all(), bodies_.rows(), context.tree_kernels, schedule_.joint_order);
  const std::uint32_t joints = min(joint_trees_.batch_count(), kMaxPieces);
  for (std::int32_t substep = 0; substep < schedule_.substeps; ++substep) add_substep(context, joints);
  add_stage(Work::store_joints, joints);
  if (context.watched) run(context);
}
/// `joints` are the pieces of a pass over joints.
template <class S> void Sequential<S>::add_substep(const StepContext<S>& context, std::uint32_t joints) {
  if (context.forces.renew != nullptr) add_stage(Work::renew_forces, 1);
  if (impacts_.any()) add_stage(Work::bounce, 1);
  add_stage(Work::integrate_velocities, body_pieces_);
  add_stage(Work::begin_contacts, 1);
  add_mechanisms(Work::place_mechanisms, context);
  add_stage(Work::warm_start_joints, joints);
  add_stages(Work::warm_start, colours_[detail::kShallow]);
  for (std::int32_t pass = 0; pass < schedule_.passes; ++pass) {
    for (std::int32_t round = 0; round < rounds_of(context); ++round) {
      add_mechanisms(Work::solve_mechanisms, context);
      add_stage(Work::solve_joints, joints);
    }
    add_pass(Work::solve, colours_[detail::kShallow], context);
  }
  if (schedule_.relaxes) add_pass(Work::solve, colours_[detail::kPressed], context);
  if (context.mechanisms.couples) add_stage(Work::close_mechanisms, 1);
  add_stage(Work::integrate_positions, body_pieces_);
  if (schedule_.relaxes) add_stage(Work::follow, 1);  // of pgs the step is over
  add_mechanisms(Work::relax_mechanisms, context);
  add_stage(Work::relax_joints, joints);
  if (!context.joint_impulses.empty()) {
    add_stage(Work::store_joints, joints);
    add_stage(Work::add_joint_impulses, 1);
  }
  if (schedule_.relaxes) {
    add_pass(Work::relax, colours_[detail::kShallow], context);
    for (int pass = 0; pass < detail::kDeepRelaxations; ++pass) add_pass(Work::relax, colours_[detail::kDeep], context);
  }
  add_mechanisms(Work::end_mechanisms, context);
}

template <class S> void Sequential<S>::store_impulses(const StepContext<S>& context) {
  add_stages(Work::store, all_);
  add_stage(Work::store_bodies, body_pieces_);
  if (bodies_.has_bound()) add_stage(Work::hold_energy, 1);
  run(context);
  impacts_.store(context);
  joints_.store(context);
}

}  // namespace isostep
