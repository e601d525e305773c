// Bodies of continuous_collision.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/continuous_collision.hpp"
#include "isostep/systems/continuous/stopped_mechanisms.inl"

namespace isostep {

template <class S>
void ContinuousCollision<S>::update(std::span<const Pose<S>> start, std::span<const std::uint64_t> joined,
                                    const ImpactRules<S>& rules) {
  motion_.begin(start);
  filter_.begin(joined, rules);
  fast_.find();
  for (Mover<S>& mover : fast_.movers()) cut(mover, false);
  if (fast_.find_bullets()) {
    for (Mover<S>& mover : fast_.movers()) {
      if (motion_.is_bullet(mover.index)) cut_bullet(mover);
    }
  }
  mechanisms_.update();
}

template <class S> void ContinuousCollision<S>::cut(Mover<S>& mover, bool moving) {
  const MotionCut<S> cut = impacts_.find(mover, moving);
  if (!cut.is_before(mover.fraction)) return;
  mover.fraction = min(cut.fraction, cut.fraction_of_middle);
  mover.stopped = cut.pose;
  if (cut.stops_middle()) {
    const Quat<Unit<S>> turned = mover.way(cut.fraction_of_middle).orientation;
    mover.stopped = {cut.place - rotate(turned, cut.middle), turned};
  }
  bodies_.stop(mover.index, cut, moving);
}
/// Cuts a bullet at moving bodies. If a fixed body stopped it before, sweeps only the way up to there.
template <class S> void ContinuousCollision<S>::cut_bullet(Mover<S>& mover) {
  Mover<S> bullet = mover.fraction == Unit<S>(1) ? mover : motion_.measure(mover.index);
  cut(bullet, true);
  if (bullet.fraction == Unit<S>(1)) return;
  stop_at_what_is_fixed(mover.index, bullet.way(bullet.fraction));
  mover.fraction = mover.fraction * bullet.fraction;
  mover.stopped = motion_.now(mover.index);
}
/// Sweeps a stopped body against fixed ones, on the way that its stopper carries it to the end of the step.
template <class S> void ContinuousCollision<S>::stop_at_what_is_fixed(std::uint32_t index, const Pose<S>& from) {
  Mover<S> carried = motion_.measure(index, {1, {from, motion_.now(index)}});
  carried.deep = true;
  if (detail::kDeepMotion<S> < carried.motion) cut(carried, false);
}

}  // namespace isostep
