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

/// Renews StepContext::accelerations as a sub-step begins, where forces depend on how bodies lie and move. Called by
/// one thread, before velocities are integrated over 1 / rate seconds. No function: they are the same throughout.
template <class S> struct SubstepForces {
  void (*renew)(void* forces, const SolverBodies<S>& bodies, std::int32_t rate) = nullptr;
  void* forces = nullptr;
};

/// What a solver does with the rows of mechanisms, in a sub-step. Called by one thread, one after another.
template <class S> struct MechanismCalls {
  /// As velocities are integrated over 1 / rate seconds: rows as the bodies lie now, and their impulses of before.
  void (*place)(void* mechanisms, SolverBodies<S>& bodies, std::int32_t rate) = nullptr;
  /// In turn with joints, before contacts.
  void (*solve)(void* mechanisms, SolverBodies<S>& bodies, int sweeps) = nullptr;
  /// Before positions, where joints are coupled: brakes and motors may slip, teeth do not.
  void (*close)(void* mechanisms, SolverBodies<S>& bodies) = nullptr;
  /// After positions: once more, so that nothing of the speed that closed errors stays.
  void (*relax)(void* mechanisms, SolverBodies<S>& bodies) = nullptr;
  /// After all else: what turns without being a body, wheels and engines, has its speed.
  void (*end)(void* mechanisms) = nullptr;
};

/// Rows of wheels and couplings. They are solved in turn with those of joints and contacts and change velocities as
/// those do; what they have to remember is theirs.
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

/// [1] Sweeps over rows of mechanisms that a sub-step takes in all of its passes: with 8 what vehicles_test.cpp
/// measures differs by less than a thousandth.
inline constexpr int kMechanismSweeps = 4;

/// No body turns by more than a radian in a step of integration [rad/s]: beyond, a turn is no longer small. What turns
/// faster is slowed to that before it moves, and reported: to turn it less than its velocity says, or about another
/// axis, would change its energy, of a rod by hundreds of times.
template <class S> ISO_INLINE constexpr Velocity<S> angular_speed_limit(std::int32_t rate) {
  return convert<Velocity<S>>(min(Limits<S>::angular_speed(), S(rate)));
}

/// Awake bodies in order, the contacts between them and their joints in canonical order.
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
  std::span<const ContactResponse<S>> responses = {};     // ascending by contact; none for `direct`
};

/// The calls of rigid_solver.hpp, for those who look at what each leaves.
enum class SolverStage : std::uint32_t { colour, prepare, solve, store };

namespace detail {
template <class S> inline constexpr Velocity<S> kPushSpeed = Velocity<S>(3);  // [m/s] overlap ends no faster
}  // namespace detail

}  // namespace isostep
