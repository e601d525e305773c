// The kernel of joint trees: W trees of joints side by side, written once for every scalar and instruction set.
// Included by one file per instruction set; everything here is inline or has internal linkage, so that no copy compiled
// for one instruction set can serve another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_factor.inl"
#include "isostep/dynamics/joints/tree_follow.inl"

namespace isostep {
namespace {

/// The kernel of W trees. All trees of a run have one shape, so that lanes differ only in numbers and never interact.
template <class S, int W, class Isa> struct TreeKernel : TreeFollower<S, W, Isa> {
  using Base = TreeFollower<S, W, Isa>;
  using Base::bounded;
  using Base::idle_lanes;
  using Base::idles;
  using Base::load;
  using Base::number;
  using Base::store;
  using Base::times;
  using typename Base::Joint;
  using typename Base::L;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::Node;
  using typename Base::V;

  static void place(const TreeRun<S>& run, const JointConstraint<S>* joints, const JointStep<S>& step) {
    const Memory m = Memory::of(run.memory, run.shape);
    Base::gather_velocities(run, m);
    Base::place_bodies(run, m, joints, step.states);
    if (run.shape.stops > 0) Base::place_stops(run, m, step.h);
    if (run.shape.follows) Base::follow(run, m, step.h);
  }
  static void linearise(const TreeRun<S>& run, const JointConstraint<S>* joints, const JointStep<S>& step) {
    const Memory m = Memory::of(run.memory, run.shape);
    Base::set_pieces(run, m);
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& drive = run.shape.drives[d];
      V::load(m.drives[d].impulse).store(m.nodes[drive.node].impulse[drive.place]);
    }
    Base::linearise(run, m, joints, step);
    if (run.shape.follows) Base::keep_rows(run, m);
  }
  static void warm_start(const TreeRun<S>& run) {
    const Memory m = Memory::of(run.memory, run.shape);
    if (run.shape.soft) Base::gather_velocities(run, m);  // of loose joints others have warm started before
    Base::set_turns(run, m);
    Base::factorise(run, m);
    for (const std::uint32_t j : run.shape.given) Base::push_all(run, j, m);
    Base::scatter_velocities(run, m);
  }

  template <bool Relax> static void solve(const TreeRun<S>& run, const JointStep<S>& step) {
    const Memory m = Memory::of(run.memory, run.shape);
    Base::gather_velocities(run, m);
    if (run.shape.drives.size() > 0) {
      solve_driven<Relax>(run, m, step);
    } else {
      find_right_sides<Relax>(run, m, step);
      substitute(run, m, softness<Relax>(step));
    }
    Base::scatter_velocities(run, m);
  }

 private:
  /// These do the same as the functions of those names in joint_rows.hpp.
  static ISO_INLINE Vec3<V> impulses(const Mat3<L>& a, Vec3<V> v) {
    const Velocity<S> most = most_joint_impulse<S>();
    return {round_within<V>(dot_sum(a.rows[0], v), most), round_within<V>(dot_sum(a.rows[1], v), most),
            round_within<V>(dot_sum(a.rows[2], v), most)};
  }
  static ISO_INLINE Vec3<V> less_moved(Vec3<V> right, const Mat3<L>& a, Vec3<V> v) {
    const Vec3<V> moved = {round_with_headroom<V>(dot_sum(a.rows[0], v)), round_with_headroom<V>(dot_sum(a.rows[1], v)),
                           round_with_headroom<V>(dot_sum(a.rows[2], v))};
    return with_headroom(right - moved);
  }

  template <bool Relax> static ISO_INLINE Softness<S> softness(const JointStep<S>& step) {
    return Relax ? Softness<S>::rigid() : step.softness;
  }

  // ---- a pass over trees with drives

  /// Solves with drives on their present pieces, and again as long as one is off its piece. Trees on their pieces
  /// repeat the same computation.
  template <bool Relax> static ISO_INLINE void solve_driven(const TreeRun<S>& run, Memory m, const JointStep<S>& step) {
    keep_start(run, m);
    Base::template bound_drives<Relax>(run, m, step);
    for (int changes = 0;; ++changes) {
      find_right_sides<Relax>(run, m, step);
      Base::ask_drives(run, m);
      for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
        const TreeDrive& drive = run.shape.drives[d];
        with_headroom(V::load(m.drives[d].right)).store(m.nodes[drive.node].right[drive.place]);
      }
      substitute(run, m, softness<Relax>(step));
      tell_drives(run, m);
      reach_stops<Relax>(run, m, step);
      if (!Base::judge_drives(run, m, changes < detail::kMostPieceChanges)) return;
      restart(run, m);
    }
  }
  static ISO_INLINE void keep_start(const TreeRun<S>& run, Memory m) {
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) {
      store(load(m.bodies[b].linear), m.bodies[b].start_linear);
      store(load(m.bodies[b].angular), m.bodies[b].start_angular);
    }
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) store(load(m.nodes[n].impulse), m.nodes[n].start);
  }
  /// A joint that turns out not to be clear has rows and bounds from then on.
  template <bool Relax> static ISO_INLINE void reach_stops(const TreeRun<S>& run, Memory m, const JointStep<S>& step) {
    if (run.shape.stops == 0 || !Base::find_reached(run, m, step.h)) return;
    Base::set_turns(run, m);
    tell_drives(run, m);
    Base::template bound_drives<Relax>(run, m, step);
  }
  /// Begins the pass again, with the next pieces.
  static ISO_INLINE void restart(const TreeRun<S>& run, Memory m) {
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) {
      store(load(m.bodies[b].start_linear), m.bodies[b].linear);
      store(load(m.bodies[b].start_angular), m.bodies[b].angular);
    }
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) store(load(m.nodes[n].start), m.nodes[n].impulse);
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& drive = run.shape.drives[d];
      V::load(m.nodes[drive.node].impulse[drive.place]).store(m.drives[d].impulse);
    }
    Base::change_pieces(run);
    Base::set_pieces(run, m);
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& drive = run.shape.drives[d];
      auto& field = m.nodes[drive.node].impulse[drive.place];
      const V old = V::load(field), now = V::load(m.drives[d].impulse);
      now.store(field);
      Base::push_row(run.shape, drive, m, now - old);
    }
    Base::factorise(run, m);
  }

  // ---- right-hand sides

  template <bool Relax>
  static ISO_INLINE void find_right_sides(const TreeRun<S>& run, Memory m, const JointStep<S>& step) {
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) {
      if (!idles(run, n)) find_right_side<Relax>(run.shape, n, m, step);
    }
    tell_drives(run, m);
  }
  /// Computes the right side of K lambda = -(speed + bias), for the velocities at the start of the pass.
  template <bool Relax>
  static ISO_INLINE void find_right_side(const TreeShape& shape, std::size_t n, Memory m, const JointStep<S>& step) {
    const TreeNode& of = shape.nodes[n];
    Node& node = m.nodes[n];
    Vec3<V> speed = Base::speed(shape, of, m);
    if (of.is_point()) speed = speed + load(m.joints[of.joint].curve);
    Vec3<V> right = -speed;
    if constexpr (!Relax) {
      right -= bounded(times(number(step.softness.bias_rate), load(node.error)), detail::kJointPushSpeed<S>);
      if (shape.joints[of.joint].closes_loop) right -= times(number(detail::kClosingCompliance<S>), load(node.impulse));
    }
    store(with_headroom(right), node.right);
  }
  static ISO_INLINE void tell_drives(const TreeRun<S>& run, Memory m) {
    for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
      const TreeDrive& drive = run.shape.drives[d];
      if (run.clear[drive.joint] == Base::kAll) continue;
      Base::speed_along(run.shape, drive, m).store(m.drives[d].speed);
      V::load(m.nodes[drive.node].impulse[drive.place]).store(m.drives[d].impulse);
    }
  }

  // ---- substitution

  static ISO_INLINE void substitute(const TreeRun<S>& run, Memory m, Softness<S> soft) {
    const std::size_t count = run.shape.nodes.size();
    for (std::size_t n = 0; n < count; ++n) substitute_up(run, n, m);
    for (std::size_t n = count; n-- > 0;) {
      substitute_down(run, n, m);
      const TreeNode& node = run.shape.nodes[n];
      if (node.of_angles || !run.shape.joints[node.joint].turns) Base::push_changes(run, node.joint, m, soft);
    }
  }
  static ISO_INLINE void substitute_up(const TreeRun<S>& run, std::size_t n, Memory m) {
    const TreeNode& of = run.shape.nodes[n];
    Node& node = m.nodes[n];
    const Vec3<V> none = {V::zero(), V::zero(), V::zero()};
    if (idles(run, n)) return store(none, node.right);
    const Mask idle = idle_lanes(run, n);
    Vec3<V> right = impulses(load(node.inverse), load(node.right));
    if (of.may_idle) right = select(idle, none, right);
    store(right, node.right);
    for (std::uint32_t l = of.first_link; l < of.first_link + of.link_count; ++l) {
      const std::uint32_t to = run.shape.links[l].to;
      if (idles(run, to)) continue;
      const Vec3<V> old = load(m.nodes[to].right), next = less_moved(old, load(m.links[l].down), right);
      store(of.may_idle ? select(idle, old, next) : next, m.nodes[to].right);
    }
  }
  static ISO_INLINE void substitute_down(const TreeRun<S>& run, std::size_t n, Memory m) {
    const TreeNode& of = run.shape.nodes[n];
    if (idles(run, n)) return;
    Vec3<V> change = load(m.nodes[n].right);
    for (std::uint32_t l = of.first_link; l < of.first_link + of.link_count; ++l) {
      const std::uint32_t to = run.shape.links[l].to;
      if (idles(run, to)) continue;
      const Vec3<V> next = less_moved(change, load(m.links[l].up), load(m.nodes[to].right));
      change = run.shape.nodes[to].may_idle ? select(idle_lanes(run, to), change, next) : next;
    }
    if (of.may_idle) change = select(idle_lanes(run, n), {V::zero(), V::zero(), V::zero()}, change);
    store(change, m.nodes[n].right);
  }
};

template <class S, int W, class Isa> constexpr TreeKernels<S> make_tree_kernels(const char* name) {
  using Kernel = TreeKernel<S, W, Isa>;
  return {name,
          W,
          &Kernel::prepare,
          &Kernel::store_impulses,
          &Kernel::place,
          &Kernel::linearise,
          &Kernel::warm_start,
          &Kernel::template solve<false>,
          &Kernel::template solve<true>};
}

}  // namespace

/// The kernels of one lane of a scalar: any machine.
#define ISO_DEFINE_SCALAR_TREE_KERNELS(S) \
  ISO_DEFINE_KERNEL_TABLE(TreeKernels<S>, Simd::scalar, make_tree_kernels<S, 1, isa::Portable>("scalar"))

}  // namespace isostep
