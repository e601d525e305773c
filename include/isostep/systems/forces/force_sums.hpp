// ForceSums<S>: what forces add up to, body by body, within the range of the scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/systems/forces/substep_bodies.hpp"

namespace isostep {

/// Input:   the forces of commands since the last step; in each sub-step accelerations and forces, in some order.
/// Output:  an acceleration for each awake body; the part of it that nothing bears; how many bodies had forces cut.
/// Keeps:   the forces of commands, until the step ends.
/// Bounds:  every summand and every sum keeps the velocity within its limits in a sub-step: Bounder.
template <class S> class ForceSums {
 public:
  ISO_INLINE ForceSums(WorldState<S>& state, const BodyMap<S>& map, const SubstepBodies<S>& bodies)
      : state_(state), map_(map), bodies_(bodies) {}

  /// Takes the forces that commands left in the state. Without those, and without records that act, there are no sums.
  void begin_step(bool any_acts);
  void begin_substep();
  void end_substep();
  /// One per awake body, or empty.
  ISO_INLINE const std::vector<Acceleration<S>>& accelerations() const { return accelerations_; }
  /// The pull on each awake body besides gravity at the end of the step, even if something holds the body. Contains all
  /// accelerations except those added by bear(). Empty: no pulls.
  ISO_INLINE std::span<const Acceleration<S>> pulls() const { return pulls_; }
  /// The number of bodies whose forces were cut in any sub-step.
  ISO_INLINE std::uint32_t cut_count() const { return cut_count_; }

  // By row of SolverBodies.
  void accelerate(std::uint32_t row, Vec3<S> acceleration);
  /// Applies a force [N] at an arm from the centre of mass. Has no effect on a body that does not move.
  void push(std::uint32_t row, Vec3<S> force, Vec3<S> arm);
  ISO_INLINE void push(const BodyEnd<S>& end, Vec3<S> force) { push(end.row, force, end.arm); }
  /// Fades a motion [m/s], or a rotation [rad/s], at a rate [1/s].
  void slow(std::uint32_t row, Vec3<S> motion, S rate);
  void slow_turning(std::uint32_t row, Vec3<S> turning, S rate);
  /// Notes what the caller's own Bounder cut. For forces that are bounded before they are pushed.
  void note_cut(std::uint32_t row, bool cut);
  /// [m/s^2] The most that a body is accelerated by.
  S most() const;
  /// Calls `act`, whose accelerations hold bodies up or back and do not count as pulls.
  template <class Act> void bear(const Act& act);

  template <class Visit> void visit_scratch(const Visit& visit) { visit("accelerations", accelerations_); }

 private:
  S most_turning(std::uint32_t row) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  const SubstepBodies<S>& bodies_;
  std::vector<Acceleration<S>> asked_, accelerations_;  // by commands; of all
  // Of all, before one that bears acts; without those, but in the last sub-step, until it ends, of those alone.
  std::vector<Acceleration<S>> before_, pulls_;
  Bitset cut_;  // awake bodies
  std::uint32_t cut_count_ = 0;
};

#define ISO_FORCE_SUMS_OF(extern, S) extern template class ForceSums<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_FORCE_SUMS_OF)

}  // namespace isostep
