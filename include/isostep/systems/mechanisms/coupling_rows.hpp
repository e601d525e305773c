// CouplingRows<S>: rows of gears, racks, pulleys and differentials, which solvers solve.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// Input:   the Coupling records, the bodies in every sub-step.
/// Output:  velocities of the bodies of coupled joints; the states of couplings.
/// Keeps:   nothing from step to step but memory: the states hold the impulses of rows.
/// Order:   couplings ascending by slot. Couplings of a train share bodies, so each sweep solves every coupling once.
///          Rows that joints resist, of bodies in several joints or far from their axis, converge too slowly with those
///          joints to be stable in turns: they close their error once, from zero impulse, before joints are solved.
///          After each row come the ends of its joints, term by term.
template <class S> class CouplingRows {
 public:
  using V = Velocity<S>;

  ISO_INLINE CouplingRows(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Lists the couplings that act.
  void begin_step();
  /// Returns true if begin_step() found any.
  ISO_INLINE bool any() const { return !runs_.empty(); }
  /// Calls visit(row) for the bodies of their joints.
  template <class Visit> ISO_INLINE void for_each_row(const Visit& visit) const {
    for (const Run& run : runs_) {
      for (int i = 0; i < run.count; ++i) {
        visit(run.terms[i].rows[0]);
        visit(run.terms[i].rows[1]);
      }
    }
  }
  // As MechanismCalls has them.
  void place(SolverBodies<S>& bodies, std::int32_t rate);
  void solve(int sweeps);
  void relax();
  /// Writes the states of the records.
  void end_step();

 private:
  static constexpr int kMostTerms = 3;
  /// [1] The part of an error that a sub-step closes: like kBaumgarte, but per sub-step.
  static constexpr S kBias = S(0.2);
  /// [1] The part of its impulse with which a row warm starts in the next sub-step. Rows of the same joints converge
  /// slowly, by a part e of their error in a sub-step. With a bias b and without a part k of the impulse, such an error
  /// x follows x''' + k x'' + e x' + e b x = 0, which grows for ever unless k > b.
  static constexpr S kWarmth = S(0.75);

  /// A joint of a coupling.
  struct Term {
    std::uint32_t index;       // of its joint
    std::uint32_t rows[2];     // of its bodies
    JointConstraint<S> joint;  // drives[0].row: of the coordinate
    S ratio;                   // [1] as the record has it
    S gear;                    // [1] speed of the sum, in rows of the first term, by speed of this one's row
    S push;                    // [1] this row's impulse by a change of the sum's speed
    // The sub-step finds where its joint ends: coupling_ends.inl.
    bool ends;
    V low, high;         // [m/s] that the row may have
    S stop[kMostTerms];  // [1] impulses of the rows by a change of this one's speed that leaves the sum's
    S bears;             // [1] what the coupling has of that: as Run::changed
    S alone;             // [1] impulse of this row by a change of its speed
    V stopped;           // [m/s] by which this sub-step has changed that speed
  };
  struct Run {
    std::uint32_t slot;  // of its record
    Term terms[kMostTerms];
    int count;
    bool turns;      // an angle is among them
    bool begins;     // nothing of this step is in `changed` yet
    bool resisted;   // by joints: a push along its rows moves bodies as their joints do not let them
    bool holds;      // something moves
    S lower, upper;  // [rad] or [m]
    S unit;          // [kg m] or [kg] impulse on the sum by a change of it in rows of the first term
    V low, high;     // [m/s] that the sum may have, in rows of the first term
    V most;          // [m/s] by which a sub-step may change it
    V changed;       // [m/s] by which this one has
    V borne;         // [m/s] likewise, for the ends of its joints

    /// Returns true if the coupling both pushes and pulls.
    bool is_equal() const { return lower == upper; }
  };

  bool sleeps(const Coupling<S>& coupling) const;
  bool acts(const Coupling<S>& coupling) const;
  void list_run(std::uint32_t slot, const Coupling<S>& coupling);
  void prepare();
  void count_joints();
  bool is_resisted(const Run& run) const;
  bool is_resisted(const Term& term, bool of_b) const;
  void sweep(int times, bool resisted, bool relaxes);
  void place(Run& run, const JointStep<S>& step) const;
  static S lever_of(const Term& term);
  void weigh(Run& run) const;
  void bound(Run& run, S sum) const;
  V most_change(const Run& run) const;
  V change_of(const Run& run, S load) const;
  S load_of(const Run& run) const;
  S coupling_of(const Term& i, const Term& j) const;
  V speed_of(const Run& run) const;
  void solve(Run& run, bool relaxes);
  void push(const Run& run, V change);
  void push(const Term& term, V impulse);
  // coupling_ends.inl
  void place_ends(Run& run) const;
  bool bound_end(Term& term) const;
  bool weigh_end(Run& run, int end) const;
  void stop(Run& run, Term& term, bool relaxes);
  bool carries(const Run& run, V borne) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<Run> runs_;
  std::vector<std::uint8_t> joints_of_;  // by row of a body that moves: how many, 2 at most
  bool prepared_ = false;  // in this step
  SolverBodies<S>* bodies_ = nullptr;
  S rate_ = S(1);
  Step<S> h_ = {};
};

#define ISO_COUPLING_ROWS_OF(extern, S) extern template class CouplingRows<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_COUPLING_ROWS_OF)

}  // namespace isostep
