// ContinuousCollision: what joints tie together stops together.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/continuous_collision.inl"

namespace isostep {

/// All bodies of a mechanism go as far as the first of them that something stops. One that stops alone is torn from the
/// rest by what that still moves in this step: a limb of a ragdoll at 60 m/s by 0.4 m. As at an impact of one body, the
/// rest of the step's time is lost.
template <class S> void ContinuousCollision<S>::stop_joined() {
  if (state_.joints.properties.empty() || !find_mechanism_fractions()) return;
  for (std::uint32_t i = 0; i < state_.awake.states.size(); ++i) {
    const Unit<S> fraction = fractions_[mechanisms_.find(i)];
    if (fraction == Unit<S>(1) || state_.awake.properties[i].type != BodyType::dynamic) continue;
    if (mover_of_[i] == 0) {
      Mover slow = {};
      slow.index = i;
      find_way(slow);
      put_back(slow, fraction);
    } else if (fraction < movers_[mover_of_[i] - 1].fraction) {
      put_back(movers_[mover_of_[i] - 1], fraction);
    }
  }
}

/// False: nothing was stopped.
template <class S> bool ContinuousCollision<S>::find_mechanism_fractions() {
  bool stopped = false;
  for (const Mover& mover : movers_) stopped = stopped || mover.fraction < Unit<S>(1);
  if (!stopped) return false;
  const std::size_t count = state_.awake.states.size();
  mechanisms_.begin(count);
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if (joint.body_a == kNoBody || joint.body_b == kNoBody) continue;
    const Location a = map_.location(joint.body_a), b = map_.location(joint.body_b);
    const bool both = a.set == Location::kAwake && b.set == Location::kAwake &&
                      map_.properties_at(a).type == BodyType::dynamic &&
                      map_.properties_at(b).type == BodyType::dynamic;
    if (both) mechanisms_.join(a.index, b.index);
  }
  mover_of_.assign(count, 0);
  for (std::size_t i = 0; i < movers_.size(); ++i) mover_of_[movers_[i].index] = static_cast<std::uint32_t>(i + 1);
  fractions_.assign(count, Unit<S>(1));
  for (const Mover& mover : movers_) {
    Unit<S>& least = fractions_[mechanisms_.find(mover.index)];
    least = min(least, mover.fraction);
  }
  return true;
}

/// To where its way was after a part of the step.
template <class S> void ContinuousCollision<S>::put_back(const Mover& mover, Unit<S> fraction) {
  std::uint32_t piece = 0;
  while (piece + 1 < mover.pieces && detail::share_of<S>(piece + 1, mover.pieces) < fraction) ++piece;
  Unit<S> of_piece = fraction - detail::share_of<S>(piece, mover.pieces);
  for (std::uint32_t parts = 1; parts < mover.pieces; parts += parts) of_piece = of_piece + of_piece;
  put_at(mover.index, pose_at(mover.motion_of(piece), of_piece));
  place(mover.index);
}

}  // namespace isostep
