// CouplingForces<S>: what gears, racks, pulleys and differentials do to their bodies, in every sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/velocity_change.hpp"

namespace isostep {

/// Input:   the Coupling records, the bodies as a sub-step finds them and what else is about to accelerate them.
/// Output:  changes of velocity of the bodies of coupled joints.
/// Keeps:   nothing from step to step but memory.
/// Order:   couplings ascending by slot, four times over: those of a train share bodies.
template <class S> class CouplingForces {
 public:
  using V = Velocity<S>;

  ISO_INLINE CouplingForces(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  ISO_INLINE bool any() const { return !state_.records->couplings.all().empty(); }
  ISO_INLINE void begin_step() { runs_.clear(); }
  /// What couplings do in a sub-step of 1 / rate seconds before which the bodies would be accelerated by that much.
  const std::vector<VelocityChange<S>>& solve(const SolverBodies<S>& bodies,
                                              const std::vector<Acceleration<S>>& accelerations, std::int32_t rate);

 private:
  static constexpr int kSweeps = 4;
  static constexpr int kMostTerms = 3;

  /// A joint of a coupling.
  struct Term {
    JointConstraint<S> joint;  // drives[0].row: of the coordinate
    S ratio;                   // [1] as the record has it
    S gear;                    // [1] speed of the sum, in rows of the first term, by speed of this one's row
    S push;                    // [1] this row's impulse by a change of the sum's speed
  };
  struct Run {
    Term terms[kMostTerms];
    int count;
    bool turns;      // an angle is among them
    bool holds;      // something moves
    S lower, upper;  // [rad] or [m]
    V low, high;     // [m/s] that the sum may have, in rows of the first term
    V most;          // [m/s] by which a sub-step may change it
    V changed;       // [m/s] by which this one has
  };

  bool acts(const Coupling<S>& coupling) const;
  void list_runs(const SolverBodies<S>& bodies);
  void place(Run& run, const JointStep<S>& step) const;
  void weigh(Run& run) const;
  void bound(Run& run, S sum) const;
  V most_change(const Run& run) const;
  S coupling_of(const Term& i, const Term& j) const;
  JointMotion<S> motion_of(const Term& term) const;
  void push(Run& run);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<Run> runs_;
  std::vector<MotionRow<V>> before_, motion_;  // by row: as the sub-step would leave it, without couplings and with
  std::vector<std::uint32_t> rows_;            // that couplings move, once each
  std::vector<VelocityChange<S>> changes_;
  const SolverBodies<S>* bodies_ = nullptr;
  S rate_ = S(1);
  Step<S> h_ = {};
};

#define ISO_COUPLING_FORCES_OF(extern, S) extern template class CouplingForces<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_COUPLING_FORCES_OF)

}  // namespace isostep
