// StepContext<S>: what one step gives its solver to work on, and where the results go.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/task_runner.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/carrying.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/contact_response.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/dynamics/joints/joint_impulse.hpp"
#include "isostep/dynamics/joints/tree_kernels.hpp"
#include "isostep/dynamics/projection.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/dynamics/solvers/body_kernels.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/geometry/limits.hpp"

namespace isostep {

/// Renews StepContext::accelerations as a sub-step begins, for forces that depend on how bodies lie and move. One
/// thread calls it before it integrates velocities over 1 / rate seconds. A null function: accelerations are constant.
template <class S> struct SubstepForces {
  void (*renew)(void* forces, const SolverBodies<S>& bodies, std::int32_t rate) = nullptr;
  void* forces = nullptr;
};

/// The calls by which a solver handles the rows of mechanisms in a sub-step. One thread makes them in this order.
template <class S> struct MechanismCalls {
  /// Places rows for current positions, as velocities are integrated over 1 / rate seconds, and their last impulses.
  void (*place)(void* mechanisms, SolverBodies<S>& bodies, std::int32_t rate) = nullptr;
  /// Solves them in turn with joints, before contacts.
  void (*solve)(void* mechanisms, SolverBodies<S>& bodies, int sweeps) = nullptr;
  /// Closes errors of joint couplings, before positions: brakes and motors may slip, teeth do not.
  void (*close)(void* mechanisms, SolverBodies<S>& bodies) = nullptr;
  /// Solves once more, after positions, so that no speed that closed errors stays.
  void (*relax)(void* mechanisms, SolverBodies<S>& bodies) = nullptr;
  /// Sets the speed of what turns without being a body (wheels, engines), after all else.
  void (*end)(void* mechanisms) = nullptr;
};

/// The rows of wheels and couplings. They are solved in turn with those of joints and contacts, and change velocities
/// as those do. They keep their own memory.
template <class S> struct MechanismRows {
  MechanismCalls<S> calls = {};
  void* mechanisms = nullptr;                  // null: there are none
  bool couples = false;                        // joints
  std::span<const std::uint32_t> bodies = {};  // rows of what they may push, ascending

  ISO_INLINE bool any() const { return mechanisms != nullptr; }
  ISO_INLINE void place(SolverBodies<S>& rows, std::int32_t rate) const { calls.place(mechanisms, rows, rate); }
  ISO_INLINE void solve(SolverBodies<S>& rows, int sweeps) const { calls.solve(mechanisms, rows, sweeps); }
  ISO_INLINE void close(SolverBodies<S>& rows) const { calls.close(mechanisms, rows); }
  ISO_INLINE void relax(SolverBodies<S>& rows) const { calls.relax(mechanisms, rows); }
  ISO_INLINE void end() const { calls.end(mechanisms); }
};

/// [1] The number of sweeps over mechanism rows in all passes of a sub-step. With 8 the results of vehicles_test.cpp
/// differ by less than a thousandth.
inline constexpr int kMechanismSweeps = 4;

/// The most that a body turns in a step of integration, a radian [rad/s]: beyond it a turn is not small. Faster bodies
/// are slowed to it before they move, and reported: to turn a body less than its velocity says, or about another axis,
/// would change its energy, of a rod by hundreds of times.
template <class S> ISO_INLINE constexpr Velocity<S> angular_speed_limit(std::int32_t rate) {
  return convert<Velocity<S>>(min(Limits<S>::angular_speed(), S(rate)));
}

/// The data of a step: awake bodies in order, contacts between them and their joints, in canonical order.
template <class S> struct StepContext {
  std::span<BodyState<S>> states = {};
  std::span<const BodyProperties<S>> properties = {};
  std::span<const Acceleration<S>> accelerations = {};  // per body, or empty
  std::span<Contact<S>> contacts = {};
  std::span<const ContactGeometry<S>> geometry = {};
  std::span<Velocity<S>> step_impulses = {};  // [m/s] per contact, of the whole step: filled by store_impulses
  std::span<const JointProperties<S>> joint_properties = {};
  std::span<JointState<S>> joint_states = {};
  std::span<const JointEnds<S>> joint_ends = {};
  Vec3<S> gravity = Vec3<S>::zero();  // [m/s^2]
  std::int32_t hz = 60;               // [1/s] steps
  std::int32_t substeps = 1;          // as the solver counts them: solver_name.hpp
  bool watched = false;               // somebody looks between the stages: none may be put off
  TaskRunner runner = {};             // changes no bit
  const ContactKernels<S>* contact_kernels = nullptr;
  const TreeKernels<S>* tree_kernels = nullptr;
  const BodyKernels<S>* body_kernels = nullptr;
  std::span<const Carried<S>> carried = {};  // ascending by contact
  SubstepForces<S> forces = {};
  MechanismRows<S> mechanisms = {};
  std::span<std::uint8_t> cut = {};  // per body, or empty: set to 1 where angular_speed_limit cuts its velocity
  Projection projection = Projection::nonlinear;          // of worst_first
  Velocity<S> restitution_threshold = Velocity<S>(0.25);  // [m/s] slower approaches do not bounce
  std::span<const JointAxisDrive<S>> axis_drives = {};    // ascending by joint
  std::span<JointImpulse<S>> joint_impulses = {};         // per joint, or empty: zeros, to which each sub-step adds
  std::span<const ContactResponse<S>> responses = {};     // ascending by contact; none where solves_islands()
};

/// The calls of rigid_solver.hpp, for tools that inspect what each leaves.
enum class SolverStage : std::uint32_t { colour, prepare, solve, store };

namespace detail {
template <class S> inline constexpr Velocity<S> kPushSpeed = Velocity<S>(3);  // [m/s] overlap ends no faster
}  // namespace detail

}  // namespace isostep
