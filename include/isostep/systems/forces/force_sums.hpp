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

/// Input:   what commands asked for since the last step; in each sub-step accelerations and forces, in some order.
/// Output:  an acceleration for each awake body; what of it nothing bears; how many bodies had forces cut.
/// Keeps:   what commands asked for, until the step ends.
/// Bounds:  every sum, as every summand, is one that changes a velocity within its limits in a sub-step: Bounder.
template <class S> class ForceSums {
 public:
  ISO_INLINE ForceSums(WorldState<S>& state, const BodyMap<S>& map, const SubstepBodies<S>& bodies)
      : state_(state), map_(map), bodies_(bodies) {}

  /// Takes what commands left in the state. Without that and without records that act there are no sums.
  void begin_step(bool any_acts);
  void begin_substep();
  void end_substep();
  /// By awake body, or empty.
  ISO_INLINE const std::vector<Acceleration<S>>& accelerations() const { return accelerations_; }
  /// The pull at each awake body beside gravity, as the step ends, whether something holds it or not: all but what
  /// bears. Empty: nothing.
  ISO_INLINE std::span<const Acceleration<S>> pulls() const { return pulls_; }
  /// Bodies of which forces were cut, in any sub-step.
  ISO_INLINE std::uint32_t cut_count() const { return cut_count_; }

  // By row of SolverBodies.
  void accelerate(std::uint32_t row, Vec3<S> acceleration);
  /// A force [N] that acts at an arm from the centre of mass. What does not move is left alone.
  void push(std::uint32_t row, Vec3<S> force, Vec3<S> arm);
  ISO_INLINE void push(const BodyEnd<S>& end, Vec3<S> force) { push(end.row, force, end.arm); }
  /// A motion [m/s], or a turning [rad/s], that fades at a rate [1/s].
  void slow(std::uint32_t row, Vec3<S> motion, S rate);
  void slow_turning(std::uint32_t row, Vec3<S> turning, S rate);
  /// An act that bounds what it computes before it pushes tells here what its Bounder cut.
  void note_cut(std::uint32_t row, bool cut);
  /// [m/s^2] That a body is accelerated by at most.
  S most() const;
  /// What `act` adds holds bodies up or back: it is not among the pulls.
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
