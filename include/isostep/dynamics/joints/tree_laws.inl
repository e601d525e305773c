// The law of drives that are limits and nothing else, of W trees. Part of tree_kernel.inl, with internal linkage like
// it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_push.inl"

namespace isostep {
namespace {

/// The functions of joint_drive.hpp, joint_drive_rows.hpp and joint_tree_drives.inl with these names, over lanes. The
/// pieces of such a drive are free, lower and upper: HeldLanes.
template <class S, int W, class Isa> struct TreeLaws : TreePusher<S, W, Isa> {
  using Base = TreePusher<S, W, Isa>;
  using Base::number;
  using typename Base::Drive;
  using typename Base::L;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::U;
  using typename Base::V;

  /// Sets the rows of drives. A free drive has none, a drive that holds has its own row.
  static ISO_INLINE void set_pieces(const TreeRun<S>& run, Memory m) {
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      if (!of.stops) continue;
      Drive& drive = m.drives[d];
      const std::uint32_t bits = run.held[d].now();
      const Mask held = Mask::from_bits(bits);
      select(held, U::broadcast(Unit<S>(1)), U::zero()).store(drive.scale);
      select(held, V::load(drive.impulse), V::zero()).store(drive.impulse);
      run.idle[of.node] &= ~bits;
    }
  }
  static ISO_INLINE void change_pieces(const TreeRun<S>& run) {
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      if (!run.shape.drives[d].stops) continue;
      HeldLanes& held = run.held[d];
      held.below = held.next_below;
      held.above = held.next_above;
    }
  }
  template <bool Relax> static ISO_INLINE void bound_drives(const TreeRun<S>& run, Memory m, const JointStep<S>& step) {
    const S bias_rate = Relax ? S(0) : step.softness.bias_rate;
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      if (!of.stops || run.clear[of.joint] == Base::kAll) continue;
      Drive& drive = m.drives[d];
      const V low = least_speed(L::load(drive.above_lower), step, bias_rate);
      const V high = -least_speed(L::load(drive.below_upper), step, bias_rate);
      const auto crossed = less(high, low);
      const V middle = Base::times(number(S(0.5)), low + high);
      select(crossed, middle, low).store(drive.low);
      select(crossed, middle, high).store(drive.high);
    }
  }
  static ISO_INLINE void ask_drives(const TreeRun<S>& run, Memory m) {
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      if (!of.stops || run.clear[of.joint] == Base::kAll) continue;
      Drive& drive = m.drives[d];
      const V speed = V::load(drive.speed);
      const V of_above = select(Mask::from_bits(run.held[d].above), V::load(drive.high) - speed, V::zero());
      select(Mask::from_bits(run.held[d].below), V::load(drive.low) - speed, of_above).store(drive.right);
    }
  }
  /// Sets the pieces to try next. Returns true if they differ from the present ones in a lane with a tree.
  static ISO_INLINE bool judge_drives(const TreeRun<S>& run, Memory m, bool may_hold) {
    bool off = false;
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      if (!of.stops) continue;
      HeldLanes& held = run.held[d];
      held.next_below = held.below;
      held.next_above = held.above;
      const std::uint32_t judged = Base::kAll & ~run.clear[of.joint], free = judged & ~held.now();
      if (judged == 0) continue;
      const Drive& drive = m.drives[d];
      const V impulse = V::load(drive.impulse), none = V::zero();
      if (held.below != 0) held.next_below &= ~to_bits(less(impulse, none));
      if (held.above != 0) held.next_above &= ~to_bits(less(none, impulse));
      if (may_hold && free != 0) {
        const V speed = V::load(drive.speed), slack = V::broadcast(detail::kPieceTolerance<S>);
        const std::uint32_t below = free & to_bits(less(speed, V::load(drive.low) - slack));
        held.next_below |= below;
        held.next_above |= free & ~below & to_bits(less(V::load(drive.high) + slack, speed));
      }
      const std::uint32_t change = (held.next_below ^ held.below) | (held.next_above ^ held.above);
      off = off || (change & run.lanes) != 0;
    }
    return off;
  }

 private:
  static ISO_INLINE V least_speed(L gap, const JointStep<S>& step, S bias_rate) {
    const L most = number(Limits<S>::speed() * step.h), deepest = number(-S(32) * step.h);
    const V distant = V::broadcast(DriveBounds<S>::limitless()), push = V::broadcast(detail::kAnglePushSpeed<S>);
    const auto apart = less(L::zero(), gap), beyond = less(most, gap);
    const V nearby = -Base::times(number(step.rate), convert<V>(min(max(gap, L::zero()), most)));
    const V back = min(-Base::times(number(bias_rate), convert<V>(min(max(gap, deepest), L::zero()))), push);
    return select(apart, select(beyond, -distant, nearby), back);
  }
};

}  // namespace
}  // namespace isostep
