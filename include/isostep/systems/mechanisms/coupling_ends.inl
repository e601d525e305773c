// Bodies of coupling_rows.hpp: where the joints of couplings end.
// SPDX-License-Identifier: MIT
//
// A rack ends, and the flywheel that drives it has a hundred times its inertia. The joint's own limit stops the rack,
// the coupling pushes it on, and in turns the two agree by a hundredth a sweep: what is left when the rack turns round
// comes out as energy. So the row of an end goes through the coupling and stops at once all that the coupling drives.
#pragma once

#include "isostep/dynamics/joints/distance.hpp"
#include "isostep/dynamics/joints/joint_drive.hpp"
#include "isostep/systems/mechanisms/coupling_rows.hpp"

namespace isostep {

namespace detail {
/// [m] The least distance of two coupled points. Closer points have no direction along which a coupling could hold
/// them: in a sub-step at 10 m/s they pass each other.
template <class S> inline constexpr S kLeastCoupledLength = S(1.0 / 32);
/// [1] The least response of a row that is more than rounding.
template <class S> inline constexpr S kLeastGive = S(64) * resolution<S>();
}  // namespace detail

template <class S> void CouplingRows<S>::place_ends(Run& run) const {
  for (int i = 0; i < run.count; ++i) {
    Term& term = run.terms[i];
    term.stopped = V(0);
    term.ends = run.holds && S(0) < abs(term.push) && bound_end(term) && weigh_end(run, i);
  }
}
/// Bounds a row by the limits of its joint, and a length between points from below: a rope ends at its wheel.
template <class S> bool CouplingRows<S>::bound_end(Term& term) const {
  const JointProperties<S>& joint = state_.joints.properties[term.index];
  JointDrive<S>& drive = term.joint.drives[0];
  if (joins_two_points(joint.type)) {
    const bool limited = DistanceJoint<S>::is_bounded(joint);
    const S least = detail::kLeastCoupledLength<S>;
    drive.bounded_below = true;
    drive.lower = limited ? max(joint.lower, min(least, joint.upper)) : least;
    if (limited) drive.upper = joint.upper;
  }
  if (!drive.bounded_below) return false;
  const DriveBounds<S> bounds = detail::bounds_of(drive, rate_, h_, kBias * rate_);
  term.low = bounds.low;
  term.high = bounds.high;
  return true;
}
/// Finds impulses along the rows that change the speed of row `end` by one and the speed of the sum by nothing. An
/// impulse along row j changes the sum by s(j), and the impulses p change it by one: sum s(j) p(j) = 1. So an impulse
/// of one along `end`, less s(end) p, is s(j) p(j) along `end` and -s(end) p(j) along j, summed over the others alone.
/// In this form nothing cancels, however heavy the others are. Only the ratios of their p count; the largest is one.
template <class S> bool CouplingRows<S>::weigh_end(Run& run, int end) const {
  const auto times = [](S a, S b) { return saturate_to<S>(product(a, b)); };
  Term& term = run.terms[end];
  const auto pull_of = [&](const Term& by) {  // of the sum, by an impulse along a row
    S sum = S(0);
    for (int i = 0; i < run.count; ++i) {
      sum = saturating_add(sum, times(run.terms[i].gear, coupling_of(run.terms[i], by)));
    }
    return sum;
  };
  S largest = S(0);
  for (int j = 0; j < run.count; ++j) {
    if (j != end) largest = max(largest, abs(run.terms[j].push));
  }
  if (largest == S(0)) return false;
  const S pull = pull_of(term);
  S own = S(0), give = S(0);
  for (int j = 0; j < run.count; ++j) {
    if (j == end) continue;
    const Term& other = run.terms[j];
    const S part = divide_to<S>(other.push, largest);
    own = saturating_add(own, times(pull_of(other), part));
    term.stop[j] = -times(pull, part);
    give = saturating_add(give, times(coupling_of(term, other), term.stop[j]));
  }
  term.stop[end] = own;
  give = saturating_add(give, times(coupling_of(term, term), own));
  term.alone = divide_to<S>(S(1), coupling_of(term, term));
  if (!(detail::kLeastGive<S> < give)) return false;
  for (int j = 0; j < run.count; ++j) term.stop[j] = divide_to<S>(term.stop[j], give);
  term.bears = -divide_to<S>(divide_to<S>(pull, give), largest);
  return true;
}

/// Stops a row at its end: changes its speed by the excess beyond the end.
template <class S> void CouplingRows<S>::stop(Run& run, Term& term, bool relaxes) {
  const V low = relaxes ? min(term.low, V(0)) : term.low, high = relaxes ? max(term.high, V(0)) : term.high;
  const JointMotion<S> motion = {bodies_->velocity[term.rows[0]], bodies_->velocity[term.rows[1]]};
  const V without = saturating_subtract(speed_along(term.joint.drives[0].row, motion), term.stopped);
  const V stopped = saturating_subtract(clamp(without, low, high), without);
  const V change = saturating_subtract(stopped, term.stopped);
  if (change == V(0)) return;
  term.stopped = stopped;
  const V borne = saturating_add(run.borne, saturate_to<V>(product(term.bears, change)));
  if (!carries(run, borne)) return push(term, saturate_to<V>(product(term.alone, change)));
  run.borne = borne;
  for (int i = 0; i < run.count; ++i) push(run.terms[i], saturate_to<V>(product(term.stop[i], change)));
}
/// Returns true if the coupling bears this impulse. With room between its bounds it bears one only while it pulls.
template <class S> bool CouplingRows<S>::carries(const Run& run, V borne) const {
  if (run.is_equal()) return true;
  const V pulls = saturating_add(run.changed, run.borne), would = saturating_add(run.changed, borne);
  return (V(0) < pulls && V(0) <= would) || (pulls < V(0) && would <= V(0));
}

}  // namespace isostep
