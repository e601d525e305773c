// The laws of drives of W trees: which row a piece of the law is, what it asks for, and which piece comes next. Part of
// tree_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_sway.hpp"
#include "isostep/dynamics/joints/tree_push.inl"

namespace isostep {
namespace {

/// The functions of joint_drive.hpp, joint_drive_rows.hpp and joint_sway.hpp with these names, over lanes. Drives of
/// joints with stops are limits and nothing else: their pieces are free, lower and upper.
template <class S, int W, class Isa> struct TreeLaws : TreePusher<S, W, Isa> {
  using Base = TreePusher<S, W, Isa>;
  using Base::number;
  using Base::times;
  using typename Base::Drive;
  using typename Base::L;
  using typename Base::Law;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::Node;
  using typename Base::U;
  using typename Base::V;

  /// Sets the rows of drives, the impulses of constant pieces, and which nodes idle. A fixed speed has its own row, a
  /// spring a weaker one that yields, other pieces none.
  static ISO_INLINE void set_pieces(const TreeRun<S>& run, Memory m) {
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) {
      run.idle[n] = run.shape.nodes[n].may_idle ? 0xffffffffu : 0u;
    }
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      const DriveLanes& lanes = run.drives[d];
      Drive& drive = m.drives[d];
      const std::uint32_t fixed = lanes.now.fixed();
      std::uint32_t acts = fixed;
      U scale = select(Mask::from_bits(fixed), U::broadcast(Unit<S>(1)), U::zero());
      V constant = V::zero();
      if (!of.stops()) {
        const Law& law = m.laws[of.law];
        const std::uint32_t yields = springs_of(law, lanes, lanes.now);
        const Mask gives = Mask::from_bits(yields);
        const L share = convert<L>(U::load(law.row_full));
        scale = select(gives, U::load(law.row_part), scale);
        select(gives, share * share, L::zero()).store(drive.give);
        constant = motor_impulse(lanes.now, V::load(law.most));
        acts |= yields;
      }
      scale.store(drive.scale);
      select(Mask::from_bits(acts), V::load(drive.impulse), constant).store(drive.impulse);
      run.idle[of.node] &= ~acts;
    }
  }
  static ISO_INLINE void change_pieces(const TreeRun<S>& run) {
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) run.drives[d].now = run.drives[d].next;
  }

  /// Sets the speeds between which limits leave drives in a pass.
  template <bool Relax> static ISO_INLINE void bound_drives(const TreeRun<S>& run, Memory m, const JointStep<S>& step) {
    const S bias_rate = Relax ? S(0) : step.softness.bias_rate;
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      if (rests(run, of)) continue;
      Drive& drive = m.drives[d];
      const V back = of.stops() ? V::broadcast(detail::kAnglePushSpeed<S>) : V::load(m.laws[of.law].back);
      const V low = least_speed(L::load(drive.above_lower), back, step, bias_rate);
      const V high = -least_speed(L::load(drive.below_upper), back, step, bias_rate);
      const auto crossed = less(high, low);
      const V middle = times(number(S(0.5)), low + high);
      select(crossed, middle, low).store(drive.low);
      select(crossed, middle, high).store(drive.high);
    }
  }

  /// Sets the right sides of the drives' rows.
  static ISO_INLINE void ask_drives(const TreeRun<S>& run, Memory m) {
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      if (rests(run, of)) continue;
      const DriveLanes& lanes = run.drives[d];
      Drive& drive = m.drives[d];
      const V speed = V::load(drive.speed);
      V right = select(Mask::from_bits(lanes.now.upper), V::load(drive.high) - speed, V::zero());
      right = select(Mask::from_bits(lanes.now.lower), V::load(drive.low) - speed, right);
      if (!of.stops()) {
        const Law& law = m.laws[of.law];
        right = select(Mask::from_bits(lanes.now.driven), V::load(law.asked) - speed, right);
        const std::uint32_t yields = springs_of(law, lanes, lanes.now);
        if (yields != 0) right = select(Mask::from_bits(yields), spring_right_side(law, lanes, drive, speed), right);
      }
      right.store(drive.right);
    }
  }

  /// Sets the pieces to try next. Returns true if a drive is off its piece in a lane with a tree. Without `may_hold`
  /// only drives count that hold a speed and should not: they let go.
  static ISO_INLINE bool judge_drives(const TreeRun<S>& run, Memory m, bool may_hold) {
    std::uint32_t off = 0;
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& of = run.shape.drives[d];
      DriveLanes& lanes = run.drives[d];
      lanes.next = lanes.now;
      if (of.sways) {
        if (may_hold) off |= judge_sway(m.laws[of.law], m.nodes[of.node]);
        continue;
      }
      const std::uint32_t judged = Base::kAll & ~run.clear[of.joint];
      if (judged == 0) continue;
      if (of.stops()) judge_stop(m.drives[d], judged, may_hold, lanes);
      else judge_law(m.laws[of.law], m.drives[d], may_hold, lanes);
      off |= lanes.next.differs(lanes.now);
    }
    return (off & run.lanes) != 0;
  }

 private:
  /// No lane reaches the joint's limits in this sub-step.
  static ISO_INLINE bool rests(const TreeRun<S>& run, const TreeDrive& of) {
    return of.stops() && run.clear[of.joint] == Base::kAll;
  }
  static ISO_INLINE V least_speed(L gap, V back, const JointStep<S>& step, S bias_rate) {
    const L most = number(Limits<S>::speed() * step.h), deepest = number(-S(32) * step.h);
    const V distant = V::broadcast(DriveBounds<S>::limitless());
    const auto apart = less(L::zero(), gap), beyond = less(most, gap);
    const V nearby = -times(number(step.rate), convert<V>(min(max(gap, L::zero()), most)));
    const V returning = min(-times(number(bias_rate), convert<V>(min(max(gap, deepest), L::zero()))), back);
    return select(apart, select(beyond, -distant, nearby), returning);
  }

  // ---- motors and springs

  static ISO_INLINE V motor_impulse(const PieceLanes& pieces, V most) {
    const V back = select(Mask::from_bits(pieces.backwards), -most, V::zero());
    return select(Mask::from_bits(pieces.forwards), most, back);
  }
  /// Returns the lanes in which the spring's force follows the speed.
  static ISO_INLINE std::uint32_t springs_of(const Law& law, const DriveLanes& lanes, const PieceLanes& pieces) {
    const std::uint32_t stiff = lanes.servos & pieces.pushed();
    return to_bits(less(L::zero(), L::load(law.spring))) & ~pieces.fixed() & ~stiff;
  }
  static ISO_INLINE V spring_impulse(const Law& law, V speed) {
    const L w = L::load(law.spring);
    const V damped = round_with_headroom<V>(product(w, speed));
    return -round_with_headroom<V>(product(w, damped + with_headroom(V::load(law.spring_push))));
  }
  static ISO_INLINE V spring_right_side(const Law& law, const DriveLanes& lanes, const Drive& drive, V speed) {
    const L share = convert<L>(U::load(law.row_full));
    const V along = times(U::load(law.row_part), speed);
    const V pushed = V::load(drive.impulse) - motor_impulse(lanes.now, V::load(law.most));
    const V push = with_headroom(times(share, V::load(law.spring_push)));
    return -(with_headroom(along + push) + round_with_headroom<V>(product(L::load(law.ratio), pushed)));
  }

  // ---- judges

  static ISO_INLINE void judge_stop(const Drive& drive, std::uint32_t judged, bool may_hold, DriveLanes& lanes) {
    const V impulse = V::load(drive.impulse), none = V::zero();
    const std::uint32_t free = judged & ~lanes.now.fixed();
    if (lanes.now.lower != 0) lanes.next.lower &= ~to_bits(less(impulse, none));
    if (lanes.now.upper != 0) lanes.next.upper &= ~to_bits(less(none, impulse));
    if (!may_hold || free == 0) return;
    const V speed = V::load(drive.speed), slack = V::broadcast(detail::kPieceTolerance<S>);
    const std::uint32_t below = free & to_bits(less(speed, V::load(drive.low) - slack));
    lanes.next.lower |= below;
    lanes.next.upper |= free & ~below & to_bits(less(V::load(drive.high) + slack, speed));
  }

  /// The piece of a drive at speeds that no limit stops: free where neither bit is set.
  struct Between {
    std::uint32_t forwards, backwards;
  };
  /// `forwards_on_tie`: the piece where the motor wants just that speed.
  static ISO_INLINE Between piece_between_limits(const Law& law, const DriveLanes& lanes, V speed,
                                                 bool forwards_on_tie) {
    Between found = {0, 0};
    if (lanes.servos != 0) {
      const V spring = spring_impulse(law, speed), most = V::load(law.most);
      found = {lanes.servos & to_bits(less(most, spring)), lanes.servos & to_bits(less(spring, -most))};
    }
    if (lanes.motors != 0) {
      const V asked = V::load(law.asked);
      const std::uint32_t slow = to_bits(less(speed, asked)), fast = to_bits(less(asked, speed));
      found.forwards |= lanes.motors & (forwards_on_tie ? ~fast : slow);
      found.backwards |= lanes.motors & (forwards_on_tie ? fast : ~slow);
    }
    return found;
  }
  /// Returns the impulse of the law at a speed between limits.
  static ISO_INLINE V impulse_between(const Law& law, const DriveLanes& lanes, Between at, V speed) {
    const PieceLanes pieces = {0, 0, 0, at.forwards, at.backwards};
    const V motor = motor_impulse(pieces, V::load(law.most));
    const std::uint32_t springs = springs_of(law, lanes, pieces);
    if (springs == 0) return motor;
    return motor + select(Mask::from_bits(springs), spring_impulse(law, speed), V::zero());
  }
  static ISO_INLINE void let_go(std::uint32_t which, Between to, PieceLanes& next) {
    next.clear(which);
    next.forwards |= which & to.forwards;
    next.backwards |= which & to.backwards;
  }

  /// Does judge_drive() and next_piece().
  static ISO_INLINE void judge_law(const Law& law, const Drive& drive, bool may_hold, DriveLanes& lanes) {
    const PieceLanes& now = lanes.now;
    const V impulse = V::load(drive.impulse), low = V::load(drive.low), high = V::load(drive.high);
    if (now.lower != 0) {
      const Between at = piece_between_limits(law, lanes, low, false);
      let_go(now.lower & to_bits(less(impulse, impulse_between(law, lanes, at, low))), at, lanes.next);
    }
    if (now.upper != 0) {
      const Between at = piece_between_limits(law, lanes, high, true);
      let_go(now.upper & to_bits(less(impulse_between(law, lanes, at, high), impulse)), at, lanes.next);
    }
    if (now.driven != 0) judge_driven(law, impulse, low, high, may_hold, lanes);
    if (may_hold && (now.fixed() & Base::kAll) != Base::kAll) judge_moving(law, drive, low, high, lanes);
  }
  static ISO_INLINE void judge_driven(const Law& law, V impulse, V low, V high, bool may_hold, DriveLanes& lanes) {
    const V asked = V::load(law.asked);
    const std::uint32_t below = lanes.now.driven & to_bits(less(asked, low));
    const std::uint32_t above = lanes.now.driven & ~below & to_bits(less(high, asked));
    const std::uint32_t within = lanes.now.driven & ~below & ~above;
    const V most = impulse_between(law, lanes, {within, 0}, asked),
            least = impulse_between(law, lanes, {0, within}, asked);
    const std::uint32_t forwards = within & to_bits(less(most, impulse));
    const std::uint32_t backwards = within & ~forwards & to_bits(less(impulse, least));
    let_go(forwards | backwards, {forwards, backwards}, lanes.next);
    if (!may_hold) return;
    lanes.next.clear(below | above);
    lanes.next.lower |= below;
    lanes.next.upper |= above;
  }
  /// Judges free and pushed drives.
  static ISO_INLINE void judge_moving(const Law& law, const Drive& drive, V low, V high, DriveLanes& lanes) {
    const PieceLanes& now = lanes.now;
    const V speed = V::load(drive.speed), slack = V::broadcast(detail::kPieceTolerance<S>);
    std::uint32_t left = Base::kAll & ~now.fixed(), passes = 0, driven = 0;
    if ((lanes.motors & now.pushed()) != 0) {
      const V asked = V::load(law.asked);
      passes = lanes.motors & ((now.forwards & to_bits(less(asked + slack, speed))) |
                               (now.backwards & to_bits(less(speed, asked - slack))));
      driven = passes & ~to_bits(less(asked, low)) & ~to_bits(less(high, asked));
      left &= ~driven;
    }
    const std::uint32_t lower = left & to_bits(less(speed, low - slack));
    left &= ~lower;
    const std::uint32_t upper = left & to_bits(less(high + slack, speed));
    left &= ~upper;
    driven |= left & passes;
    lanes.next.clear(lower | upper | driven);
    lanes.next.lower |= lower;
    lanes.next.upper |= upper;
    lanes.next.driven |= driven;
    left &= lanes.servos;
    if (left == 0) return;
    const V spring = spring_impulse(law, speed), most = V::load(law.most);
    const std::uint32_t free = left & ~now.pushed();
    const std::uint32_t eases =
        (now.forwards & to_bits(less(spring + slack, most))) | (now.backwards & to_bits(less(slack - most, spring)));
    lanes.next.clear(left & eases);
    const std::uint32_t forwards = free & to_bits(less(most + slack, spring));
    lanes.next.forwards |= forwards;
    lanes.next.backwards |= free & ~forwards & to_bits(less(spring, -most - slack));
  }

  // ---- sway

  /// Sets a new damper in lanes whose rod pulls so much harder in this pass that its ends would be driven; returns
  /// them. The rod's own row is the first of the block.
  static ISO_INLINE std::uint32_t judge_sway(Law& law, const Node& node) {
    const V tension = max(-V::load(node.impulse[0]), V::zero());
    const L excess = round_saturated<L>(product(L::load(law.sway), tension)) - L::load(law.sway_left);
    const L w = L::load(law.spring);
    const Mask off = less(L::load(law.sway_left) + number(S(1.5)) * (w * w), excess);
    if (!any(off)) return 0;
    const Mask acts = off & less(number(S(8) * resolution<S>()), excess);
    const L spring = select(acts, root(select(acts, excess, L::zero())), L::zero());
    const Direction<L> row = direction_where(off, number(S(1)), spring, L::zero());
    const L ratio = quotient_where<L>(acts, convert<L>(row.x), spring);
    select(off, spring, w).store(law.spring);
    select(off, ratio, L::load(law.ratio)).store(law.ratio);
    select(off, row.x, U::load(law.row_full)).store(law.row_full);
    select(off, row.y, U::load(law.row_part)).store(law.row_part);
    return to_bits(off);
  }
};

}  // namespace
}  // namespace isostep
