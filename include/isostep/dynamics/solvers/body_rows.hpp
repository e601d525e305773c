// BodyRows<S>: the awake bodies as every solver moves them: rows gathered from the state, integrated, written back.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/energy_bound.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// Order:   velocity before position (semi-implicit Euler), gyroscopic term by the midpoint rule, damping implicit.
/// Threads: ranges of bodies that do not meet may be gathered, integrated and stored side by side.
template <class S> class BodyRows {
 public:
  /// Makes room for the bodies of a step whose sub-steps take 1 / rate seconds.
  void begin(const StepContext<S>& context, std::int32_t rate);
  /// Gathers velocities and masses of bodies first..end-1 once a step, with zero displacement. Returns true if contacts
  /// must follow any of them.
  bool gather_range(const StepContext<S>& context, std::size_t first, std::size_t end);
  /// Notes that a contact touches the row's body. It is gathered.
  ISO_INLINE void meet(std::uint32_t row) {
    if (row != 0) kinds_[row - 1] |= body_kind::kMet;
  }
  /// Finds whose energy is bound. It may run beside other threads that gather. `binds_joints`: energy_bound.hpp.
  ISO_INLINE void bind(const StepContext<S>& context, bool binds_joints) {
    bound_.begin(context, divide_to<Step<S>>(S(1), S(rate_)), binds_joints);
  }
  /// Does all of that, on one thread. Returns true if contacts must follow any body.
  bool gather(const StepContext<S>& context, std::int32_t rate, bool binds_joints);

  /// Renews forces before the velocities of a sub-step.
  ISO_INLINE void renew_forces(const StepContext<S>& context) const {
    if (context.forces.renew != nullptr) context.forces.renew(context.forces.forces, rows_, rate_);
  }
  // These move bodies first..end-1 by a sub-step.
  void integrate_velocities(const StepContext<S>& context, std::size_t first, std::size_t end);
  /// Returns true if contacts must follow any of them.
  bool integrate_positions(const StepContext<S>& context, std::size_t first, std::size_t end);

  /// Returns true if contacts follow the row's body, because it turns fast: contact_follow.hpp.
  ISO_INLINE bool is_followed(const StepContext<S>& context, std::uint32_t row) const {
    const Velocity<S> turns = max_abs(rows_.velocity[row].angular);
    return row != 0 && angular_speed_to_renew<S>(context.hz, true) < turns &&
           is_uneven(context.properties[row - 1], context.hz, turns);
  }
  /// Renews the row's inertia about world axes.
  void renew_inertia(const StepContext<S>& context, std::uint32_t row);

  /// Makes free turning accept the row's angular velocity: no part of it is a push of the solver (gyroscopic.hpp).
  ISO_INLINE void accept_turning(const StepContext<S>& context, std::uint32_t row) {
    if (row == 0 || (kinds_[row - 1] & body_kind::kTurns) == 0) return;
    const Mat3<Unit<S>> axes = detail::world_axes(context.states[row - 1].orientation, context.properties[row - 1]);
    turns_[row - 1].known = transposed_times(axes, rows_.velocity[row].angular);
  }

  /// Stores velocities in context.states, after integration.
  void store(const StepContext<S>& context, std::size_t first, std::size_t end) const;
  /// Returns true if an energy bound holds for all rows together.
  ISO_INLINE bool has_bound() const { return bound_.any(); }
  ISO_INLINE void hold_energy(const StepContext<S>& context) const { bound_.hold(context, rows_); }

  /// See rigid_solver.hpp.
  template <class Visit> void visit_scratch(const Visit& visit, SolverStage stage);

  /// [m/s] Returns the velocity that forces add to a row in the sub-step.
  ISO_INLINE Vec3<Velocity<S>> gain_of(const StepContext<S>& context, std::uint32_t row) const {
    if (!rows_.moves(row)) return Vec3<Velocity<S>>::zero();
    const Vec3<Velocity<S>> fall = flights_[row - 1].fall;
    if (context.accelerations.empty()) return fall;
    const Step<S> h = divide_to<Step<S>>(S(1), S(rate_));
    const Vec3<S> a = context.accelerations[row - 1].linear;
    if (a == Vec3<S>::zero()) return fall;  // as if nothing pulled any body
    const auto over = [h](S x) ISO_INLINE_LAMBDA { return round_to<Velocity<S>>(product(x, h)); };
    return fall + Vec3<Velocity<S>>{over(a.x), over(a.y), over(a.z)};
  }
  ISO_INLINE std::int32_t rate() const { return rate_; }
  ISO_INLINE std::size_t count() const { return rows_.mass.size() - 1; }
  ISO_INLINE SolverBodies<S>& rows() { return rows_; }
  ISO_INLINE const SolverBodies<S>& rows() const { return rows_; }

 private:
  static bool is_uneven(const BodyProperties<S>& body, std::int32_t hz, Velocity<S> angular_speed);
  BodyRun<S> run_of(const StepContext<S>& context, std::size_t first, std::size_t end);
  void gather_turn(const BodyState<S>& state, const BodyProperties<S>& body, const Mat3<Unit<S>>& axes, std::size_t i);
  Mat3<Unit<S>> axes_in_the_middle(const StepContext<S>& context, std::size_t i) const;
  void finish_velocity(const StepContext<S>& context, std::size_t body, bool turned);
  void move(const StepContext<S>& context, std::size_t body);
  bool limit_turn(const StepContext<S>& context, std::size_t body);

  SolverBodies<S> rows_;
  // One a body:
  std::vector<Vec3<S>> start_;  // [m] centres when the step began
  std::vector<std::uint8_t> kinds_;
  std::vector<BodyFactors<S>> factors_;
  std::vector<BodyFlight<S>> flights_;
  std::vector<BodyTurn<S>> turns_;  // of those that turn freely
  EnergyBound<S> bound_;
  std::vector<std::uint32_t> left_;  // to be finished one by one
  std::int32_t rate_ = 1;            // [1/s] sub-steps
};

#define ISO_EXTERN_BODY_ROWS(S) extern template class BodyRows<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_BODY_ROWS)
#undef ISO_EXTERN_BODY_ROWS

}  // namespace isostep
