// The sub-steps of soft_step.hpp as stages of pieces: what threads do side by side, and in which order.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/gyroscopic.hpp"
#include "isostep/dynamics/solvers/soft_step.hpp"

namespace isostep {

namespace detail {

// Contacts are springs of an eighth of the sub-step rate. A quarter, all that one spring alone allows, leaves a wall of
// 210 boxes trembling at 1e-3 J/kg, an eighth at 1e-9: springs that share a body stiffen one another and one pass over
// them does not converge. Softer ones sag: a stack of n boxes sags 3.5 n^2 / substeps^2 mm and buckles once that nears
// 50. The angle a sub-step is pi / 4 whatever the rate, and so the coefficients are constants.
template <class S> inline constexpr S kContactAngle = S(0.785398163397448309616);    // [rad]
template <class S> inline constexpr S kContactDamping = S(5);                        // [1] of critical
template <class S> inline constexpr Velocity<S> kPushSpeed = Velocity<S>(3);         // [m/s]
template <class S> inline constexpr Velocity<S> kRestitutionSpeed = Velocity<S>(1);  // [m/s]

/// No motion along and about locked axes, whatever pushed.
template <class V> ISO_INLINE void hold_locks(std::uint32_t flags, MotionRow<V>& row) {
  if ((flags & body_flag::kAllLocks) == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    if ((flags & (body_flag::kLockX << axis)) != 0) row.linear.set(axis, V(0));
    if ((flags & (body_flag::kLockAngularX << axis)) != 0) row.angular.set(axis, V(0));
  }
}

template <class S> ContactPass<S> contact_pass(const SolverInput<S>& input) {
  const S rate = S(input.hz * input.substeps);
  // A gap wider than a sub-step covers at 64 m/s counts as that: nothing so far apart closes within the sub-step. Loads
  // beyond a 64th of the format (32 m/s for Q16.16) count as that: times friction and the cone's slope they still fit.
  return {soften(kContactAngle<S>, kContactDamping<S>, rate),
          rate,
          kPushSpeed<S>,
          divide_to<Velocity<S>>(S(64), rate),
          highest<Velocity<S>>() * Velocity<S>(1.0 / 64),
          kRestitutionSpeed<S>};
}
}  // namespace detail

template <class S>
void SoftStep<S>::integrate_velocities(const SolverInput<S>& input, std::size_t first, std::size_t end) {
  using V = Velocity<S>;
  const std::int32_t rate = input.hz * input.substeps;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const auto times = [](auto a, auto b) { return round_to<V>(product(a, b)); };
  for (std::size_t i = first; i < end; ++i) {
    const BodyProperties<S>& body = input.properties[i];
    if (body.type != BodyType::dynamic) continue;
    MotionRow<V>& row = bodies_.velocity[i + 1];
    Vec3<S> acceleration = body.gravity_scale == S(1) ? input.gravity : input.gravity * body.gravity_scale;
    if (!input.accelerations.empty()) {
      acceleration += input.accelerations[i].linear;
      const Vec3<S> turning = input.accelerations[i].angular;
      row.angular += {times(turning.x, h), times(turning.y, h), times(turning.z, h)};
    }
    row.linear += {times(acceleration.x, h), times(acceleration.y, h), times(acceleration.z, h)};
    // Implicit: v' = v / (1 + h c), stable at any damping.
    if (body.linear_damping > S(0)) {
      const S keep = S(1) / (S(1) + body.linear_damping * h);
      row.linear = {times(keep, row.linear.x), times(keep, row.linear.y), times(keep, row.linear.z)};
    }
    if (body.angular_damping > S(0)) {
      const S keep = S(1) / (S(1) + body.angular_damping * h);
      row.angular = {times(keep, row.angular.x), times(keep, row.angular.y), times(keep, row.angular.z)};
    }
    if ((body.flags & body_flag::kSpins) != 0) {
      row.angular =
          turn_freely<S>(to_matrix(input.states[i].orientation * body.principal), inertia_[i], row.angular, h);
    }
    detail::hold_locks(body.flags, row);
  }
}

template <class S>
void SoftStep<S>::integrate_positions(const SolverInput<S>& input, std::size_t first, std::size_t end) {
  using V = Velocity<S>;
  const std::int32_t rate = input.hz * input.substeps;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const V fastest = spin_limit<S>(rate);
  const auto times = [](V a, Step<S> b) { return round_to<V>(product(a, b)); };
  for (std::size_t i = first; i < end; ++i) {
    MotionRow<V>& v = bodies_.velocity[i + 1];
    detail::hold_locks(input.properties[i].flags, v);
    MotionRow<V>& d = bodies_.displacement[i + 1];
    BodyState<S>& state = input.states[i];
    const Vec3<V> move = {times(v.linear.x, h), times(v.linear.y, h), times(v.linear.z, h)};
    const auto turn = [&](V w) { return round_to<Unit<S>>(product(clamp(w, -fastest, fastest), h)); };
    // The centre follows the displacement, not the moves: where S is coarse, small moves add up before they round.
    const Vec3<S> before = convert<S>(d.linear);
    d.linear += move;
    d.angular += {times(v.angular.x, h), times(v.angular.y, h), times(v.angular.z, h)};
    state.centre += convert<S>(d.linear) - before;
    state.orientation =
        integrate(state.orientation, Vec3<Unit<S>>{turn(v.angular.x), turn(v.angular.y), turn(v.angular.z)});
  }
}

template <class S> void SoftStep<S>::add_stage(Work work, std::uint32_t of_plan, std::uint32_t pieces) {
  stages_.push_back({work, of_plan});
  pieces_.push_back(pieces);
}
template <class S> void SoftStep<S>::add_stages(Work work, const PassPlan& plan) {
  for (std::uint32_t i = 0; i < plan.stages().size(); ++i) add_stage(work, i, plan.stages()[i]);
}

template <class S> void SoftStep<S>::run(const SolverInput<S>& input) {
  const S rate = S(input.hz * input.substeps);
  Job job = {this,
             input,
             detail::contact_pass(input),
             {input.states.data(), &bodies_, rate, divide_to<Step<S>>(S(1), rate), joint_softness(rate)}};
  run_stages(runner_, pieces_, &SoftStep::do_piece, &job);
  stages_.clear();
  pieces_.clear();
}

template <class S> void SoftStep<S>::do_piece(void* data, std::uint32_t stage, std::uint32_t piece) {
  const Job& job = *static_cast<const Job*>(data);
  SoftStep& solver = *job.solver;
  const Stage& what = solver.stages_[stage];
  switch (what.work) {
    case Work::integrate_velocities:
    case Work::integrate_positions:
    case Work::store_bodies: return solver.do_bodies(job, what.work, piece);
    case Work::warm_start_joints:
    case Work::solve_joints:
    case Work::relax_joints:
    case Work::store_joints: return solver.do_joints(job, what.work, piece);
    default: break;
  }
  const bool all = what.work == Work::prepare || what.work == Work::store;
  const PassPlan& plan = all ? solver.all_ : solver.colours_;
  for (const PassPlan::Slice& slice : plan.piece(what.of_plan, piece)) solver.do_slice(job, what.work, slice);
}

template <class S> void SoftStep<S>::do_slice(const Job& job, Work work, const PassPlan::Slice& slice) {
  const Run& run = runs_[slice.run];
  switch (work) {
    case Work::prepare: return prepare_slice(job.input, slice);
    case Work::warm_start: return run.kernels->warm_start[run.variant](blocks_of(slice));
    case Work::solve: return run.kernels->solve[run.variant](blocks_of(slice), job.pass);
    case Work::relax: return run.kernels->relax[run.variant](blocks_of(slice), job.pass);
    case Work::restitute: return run.kernels->restitute[run.variant](blocks_of(slice), job.pass);
    case Work::store: return store_slice(job.input, slice);
    default: return;
  }
}

template <class S> void SoftStep<S>::do_bodies(const Job& job, Work work, std::uint32_t piece) {
  const std::size_t count = job.input.states.size();
  const std::size_t first = count * piece / body_pieces_, end = count * (piece + 1) / body_pieces_;
  if (work == Work::integrate_velocities) return integrate_velocities(job.input, first, end);
  if (work == Work::integrate_positions) return integrate_positions(job.input, first, end);
  for (std::size_t i = first; i < end; ++i) {
    job.input.states[i].velocity = bodies_.velocity[i + 1].linear;
    job.input.states[i].spin = bodies_.velocity[i + 1].angular;
  }
}

template <class S> void SoftStep<S>::do_joints(const Job& job, Work work, std::uint32_t piece) {
  const std::uint32_t count = joint_trees_.batch_count(), pieces = min(count, kMaxPieces);
  for (std::uint32_t i = count * piece / pieces; i < count * (piece + 1) / pieces; ++i) {
    if (work == Work::warm_start_joints) joint_trees_.warm_start(i, job.input.joints, job.joints);
    else if (work == Work::store_joints) joint_trees_.store(i, job.input.joints);
    else joint_trees_.solve(i, job.input.joints, job.joints, work == Work::relax_joints);
  }
}

template <class S> void SoftStep<S>::prepare() {
  memory_.resize((memory_bytes_ + 63) / 64 + 1);
  block_bodies_.resize(block_count_ + 1);
  add_stages(Work::prepare, all_);
}

template <class S> void SoftStep<S>::solve_substeps(const SolverInput<S>& input, const TreeKernels<S>& trees) {
  joint_trees_.plan(input.joints, bodies_, &trees);
  const std::uint32_t joints = min(joint_trees_.batch_count(), kMaxPieces);
  for (std::int32_t substep = 0; substep < input.substeps; ++substep) {
    add_stage(Work::integrate_velocities, 0, body_pieces_);
    add_stage(Work::warm_start_joints, 0, joints);
    add_stages(Work::warm_start, colours_);
    add_stage(Work::solve_joints, 0, joints);
    add_stages(Work::solve, colours_);
    add_stage(Work::integrate_positions, 0, body_pieces_);
    add_stage(Work::relax_joints, 0, joints);
    add_stages(Work::relax, colours_);
  }
  add_stage(Work::store_joints, 0, joints);
}

template <class S> void SoftStep<S>::restitute(const SolverInput<S>& input) {
  bool bounces = false;
  for (const ContactGeometry<S>& g : input.geometry) bounces = bounces || g.material.restitution > S(0);
  if (bounces) add_stages(Work::restitute, colours_);
}

template <class S> void SoftStep<S>::store_impulses() {
  add_stages(Work::store, all_);
  add_stage(Work::store_bodies, 0, body_pieces_);
}

}  // namespace isostep
