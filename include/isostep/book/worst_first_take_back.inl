// The projection velocity_based of worst_first.hpp: bodies taken back along their own motion to where they touched.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/worst_first.hpp"

namespace isostep {

/// Source:  Millington 2007, pp. 322-323: bodies go back to the moment of touch, at the velocities they came with.
/// Symbols: l = what a row lacks to touch, m = what a body moved in the step before and nothing took back yet, at first
///          its velocity times the length of a step, c = how far the two m of a row closed it.
/// Rule:    a row that lacks l <= c was overlapping for the share l / c of the motion: both bodies go back by that
///          share of their m, turning included. Where c < l all of it goes back. The rest is for the sub-steps, which
///          move it along the normal: what overlaps without closing, what overlapped before, what else was in the way.
/// Order:   worst first, by what can go back. Who goes back takes along who followed it.
/// Differs: at a step's beginning, for contacts are found once a step. Velocities stay: the first sub-step has the
///          impact, at the place of the touch; the time between is lost. Within a step no gap closes to an overlap.
/// Error:   c is above kProjectionTolerance and l / c at most 1: no quotient of what is nearly nothing.
/// Limits:  kinematic bodies stay where they are. What turns by more than kMostProjectedTurn a step is moved alone.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::take_back(const StepContext<S>& context) {
  recall_motion(context);
  const auto points = static_cast<std::uint32_t>(points_.size());
  resolve([&](std::uint32_t i) { return i < points ? recall_urgency(points_[i]) : V(0); },
          [&](std::uint32_t i) { recall(context, points_[i]); }, 1);
}

template <class S, class Queue> void WorstFirstResolver<S, Queue>::recall_motion(const StepContext<S>& context) {
  const SolverBodies<S>& bodies = bodies_.rows();
  const Step<S> h = divide_to<Step<S>>(S(1), S(context.hz));
  const auto times = [h](Vec3<V> v) {
    const auto of = [h](V x) { return round_to<V>(product(x, h)); };
    return Vec3<V>{of(v.x), of(v.y), of(v.z)};
  };
  moved_.assign(bodies.velocity.size(), Motion::zero());
  for (std::uint32_t i = 0; i < moved_.size(); ++i) {
    if (!bodies.moves(i)) continue;
    moved_[i].linear = times(bodies.velocity[i].linear);
    const Vec3<V> turned = times(bodies.velocity[i].angular);
    if (!(detail::kMostProjectedTurn<S> < max_abs(turned))) moved_[i].angular = turned;
  }
}

template <class S, class Queue> Velocity<S> WorstFirstResolver<S, Queue>::recalled(const Point& row) const {
  return saturating_subtract(V(0), detail::along(row.normal, moved_[row.a], moved_[row.b]));
}

template <class S, class Queue> Velocity<S> WorstFirstResolver<S, Queue>::recall_urgency(const Point& row) const {
  const V missing = saturating_subtract(-detail::kRestingOverlap<S>, gap(row));
  if (!(detail::kProjectionTolerance<S> < missing) || row.most < highest<V>()) return V(0);
  const V closed = min(recalled(row), missing);
  return detail::kProjectionTolerance<S> < closed ? closed : V(0);
}

template <class S, class Queue>
void WorstFirstResolver<S, Queue>::recall(const StepContext<S>& context, const Point& row) {
  const V missing = saturating_subtract(-detail::kRestingOverlap<S>, gap(row)), closed = recalled(row);
  const S share = missing < closed ? divide_to<S>(missing, closed) : S(1);
  undo(context, row.a, share);
  undo(context, row.b, share);
}

template <class S, class Queue>
void WorstFirstResolver<S, Queue>::undo(const StepContext<S>& context, std::uint32_t body, S share) {
  if (!bodies_.rows().moves(body)) return;
  Motion& moved = moved_[body];
  const auto part = [share](Vec3<V> v) {
    const auto of = [share](V x) { return -saturate_to<V>(product(share, x)); };
    return Vec3<V>{of(v.x), of(v.y), of(v.z)};
  };
  Motion back = Motion::zero();
  back.linear = part(moved.linear);
  back.angular = part(moved.angular);
  moved.linear += back.linear;
  moved.angular += back.angular;
  move(context, body, back);
}

}  // namespace isostep
