// Impacts<S>: what meets fast and bounces, for every solver: before each sub-step, all that meet in it at once.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/disjoint_sets.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/dynamics/solvers/row_pushes.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// A point of a contact that bounces in a sub-step.
template <class S> struct TouchRow {
  std::uint32_t bouncing;  // of Impacts::bouncing_
  std::uint32_t point;     // of the contact
  std::uint32_t group;     // of Impacts::groups_: what touches meet the same moving bodies
  JointRow<S> normal;      // turns hold the mass shares
  MassShare<S> share;
  S mass;               // [1] effective
  S time;               // [1] sub-steps from its begin to the impact
  S weight;             // [1] reduced mass of its pair, of the heaviest in its group
  Velocity<S> forced;   // [m/s] what forces add to its speed until then
  Velocity<S> met;      // [m/s] speed at the impact, < 0
  Velocity<S> impulse;  // [m/s] >= 0
};

/// Source:  Poisson's law: the impulse that stopped an approach is given once more, times the restitution e. Smith et
///          al. 2012, Reflections on Simultaneous Impact: all touches at one time are stopped at once, so that symmetry
///          stays; what then meets anew bounces in a further round, as balls of a cradle do one after another.
/// Symbols: e = restitution, met = speed at the impact, time = when it comes.
/// Method:  a contact whose gap would close within the sub-step, faster than Settings::restitution_threshold, bounces
///          when it closes: with the speed that forces gave it until then. The bodies go on from that place. A contact
///          that is found only when it overlaps bounced within the step before.
///          Projected Gauss-Seidel finds the impulses that stop all touches. Along these, converged or not, energy is a
///          parabola of the scale: at s a group loses most, and at (1 + e) s it loses 1 - e^2 of that. So no group
///          gains energy, at any e and after any number of passes.
///          Friction, within the cone of what each point bore, only takes energy.
/// Limits:  kMostRounds rounds, kMostWork rows: what meets then is stopped as if it had no restitution. Contacts that
///          bear only so much (KindResponse::most_force) do not bounce.
/// Threads: one. Contacts that do not bounce cost nothing. The order is that of the contacts.
template <class S> class Impacts {
  using V = Velocity<S>;
  using Motion = MotionRow<V>;

 public:
  /// Begins a step, after bodies were gathered.
  void begin(const StepContext<S>& context, const SolverBodies<S>& bodies);
  /// Returns true if any contact of the step may bounce.
  ISO_INLINE bool any() const { return !bouncing_.empty(); }
  /// Solves bounces, before a sub-step integrates velocities and after its forces are known.
  void bounce(const StepContext<S>& context, BodyRows<S>& bodies);
  /// Adds the impulses of bounces, after the solver has stored those of contacts.
  void store(const StepContext<S>& context) const;

 private:
  static constexpr int kMostRounds = 32;
  static constexpr int kMostPasses = 64;
  static constexpr std::uint32_t kMostWork = 1u << 18;  // rows solved in a sub-step: some 20 ms

  struct Bouncing {
    std::uint32_t contact;
    bool fresh;  // it did not touch in the step before
    MassShare<S> share;
    S reduced;  // [kg]
    V given;    // [m/s] in the step
  };
  /// Sums over touches, of speeds over the fastest: of the stopping impulses (stopping) and those given (work, curve).
  struct Group {
    V fastest = V(0);   // [m/s]
    S heaviest = S(0);  // [kg]
    S stopping = S(0), work = S(0), curve = S(0), scale = S(1);
    std::uint32_t touches = 0;
    V change = V(0);          // [m/s] largest of an impulse in the last pass
    bool is_stopped = false;  // or has no touches
  };

  void find(const StepContext<S>& context, const BodyRows<S>& bodies, bool first);
  bool end_pass();
  void look_at(const StepContext<S>& context, const BodyRows<S>& bodies, std::uint32_t index);
  static bool meets(V gap, V speed, V forced, std::int32_t rate, S before, TouchRow<S>& touch);
  SolverMass<S> seen(const StepContext<S>& context, const SolverBodies<S>& bodies, const Bouncing& of, bool is_a) const;
  void group(const StepContext<S>& context, const SolverBodies<S>& bodies);
  V speed_of(const TouchRow<S>& touch, const ContactGeometry<S>& g, const SolverBodies<S>& bodies) const;
  void stop(const StepContext<S>& context, SolverBodies<S>& bodies);
  void give_back(const StepContext<S>& context, SolverBodies<S>& bodies);
  void find_scales();
  void apply_scales(const StepContext<S>& context, SolverBodies<S>& bodies, std::int32_t rate);
  void rub(const StepContext<S>& context, SolverBodies<S>& bodies);
  ISO_INLINE const ContactGeometry<S>& geometry_of(const StepContext<S>& context, const TouchRow<S>& touch) const {
    return context.geometry[bouncing_[touch.bouncing].contact];
  }

  std::vector<Bouncing> bouncing_;      // contacts of the step with a restitution, ascending
  std::vector<TouchRow<S>> touches_;    // of a round
  std::vector<std::uint32_t> changed_;  // of each row of the bodies: the last round that changed it
  std::vector<std::uint32_t> local_;    // of each row that changed: its number in the round
  std::vector<Group> groups_;
  DisjointSets sets_;
  std::uint32_t round_ = 0;  // of the step
  std::uint32_t work_ = 0;
};

#define ISO_EXTERN_IMPACTS(S) extern template class Impacts<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_IMPACTS)
#undef ISO_EXTERN_IMPACTS

}  // namespace isostep
