// Bodies of first_impacts.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/systems/continuous/fast_bodies.inl"
#include "isostep/systems/continuous/first_impacts.hpp"

namespace isostep {

/// Finds obstacles by their fat boxes. The tree shows at least these; what it shows beyond depends on its history.
template <class S> void FirstImpacts<S>::find_obstacles(const Mover<S>& mover, bool moving) {
  const Vec3<S> from = mover.from().position, way = mover.to().position - from;
  const Vec3<S> middle = (mover.around.low + mover.around.high) * S(0.5), half = mover.around.high - middle;
  const Sweep<S> sweep = {from + middle, way, half, Unit<S>(1)};
  const auto may_stop = [&](std::uint32_t slot) { return filter_.may_stop(mover.index, slot, moving); };
  const Aabb<S> swept = mover.swept();
  obstacles_.clear();
  if (!moving && fast_.knows_fixed()) {
    for (const auto& fixed : fast_.fixed()) {
      if (overlap(fixed.fat, swept) && may_stop(fixed.slot) &&
          detail::SweepTest<S>(sweep, fixed.fat).touches(fixed.fat))
        obstacles_.push_back(fixed.slot);
    }
  } else {
    proxies_.boxes().sweep(sweep, [&](std::uint32_t slot, Unit<S> max_fraction) {
      const Aabb<S>& fat = map_.state_at(map_.location(slot)).fat;
      if (may_stop(slot) && detail::SweepTest<S>(sweep, fat).touches(fat)) obstacles_.push_back(slot);
      return max_fraction;
    });
  }
  if (moving) {
    fast_.comers().query(swept, [&](std::uint32_t slot) {
      if (may_stop(slot)) obstacles_.push_back(slot);
      return true;
    });
  }
  for (const auto& carrier : fast_.carriers()) {  // wherever they are by now
    if (overlap(carrier.swept, swept) && may_stop(carrier.slot)) obstacles_.push_back(carrier.slot);
  }
  sort_scratch_.resize(obstacles_.size());
  stable_sort(obstacles_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(obstacles_.size()), OwnKey{});
}

template <class S> MotionCut<S> FirstImpacts<S>::sweep(const Mover<S>& mover) const {
  MotionCut<S> cut = {mover.fraction, motion_.now(mover.index), mover.fraction, {}, {}, {}};
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    if (i == 0 || obstacles_[i] != obstacles_[i - 1]) pairs_.sweep(mover, obstacles_[i], cut);
  }
  return cut;
}

/// Finds the point at which the mover touches its first obstacle at rest, at the start of the step.
template <class S> bool FirstImpacts<S>::find_touch(Mover<S>& mover) const {
  for (const std::uint32_t slot : obstacles_) {
    if (motion_.is_at_rest(map_.location(slot)) && pairs_.find_touch(mover, slot)) return true;
  }
  return false;
}

/// Finds the end of a motion. A body that touches at the start moves as if it turned about that point, not about its
/// centre of mass. Otherwise the end of a rod that tips over dips into the ground, and the rod never moves. All
/// obstacles see the same path.
template <class S> MotionCut<S> FirstImpacts<S>::find(Mover<S>& mover, bool moving) {
  find_obstacles(mover, moving);
  const MotionCut<S> cut = sweep(mover);
  if (!cut.is_before(mover.fraction) || moving || !find_touch(mover)) return cut;
  return sweep(mover);
}

}  // namespace isostep
