// The kernel of joint trees: W trees of ball joints side by side, written once for every scalar and instruction set.
// Included by one file per instruction set; everything here is inline or has internal linkage, so that no copy compiled
// for one instruction set can serve another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_factor.inl"
#include "isostep/scalar/lanes_bounded.hpp"

namespace isostep {
namespace {

/// What JointTrees does for joints of any kind, for those that hold a point and nothing else. All trees of a run have
/// one shape, so that what differs between lanes are numbers; lanes never meet.
template <class S, int W, class Isa> struct TreeKernel : TreeFactoriser<S, W, Isa> {
  using Base = TreeFactoriser<S, W, Isa>;
  using Base::load;
  using Base::number;
  using Base::store;
  using Base::times;
  using typename Base::Body;
  using typename Base::Joint;
  using typename Base::L;
  using typename Base::Memory;
  using typename Base::V;

  static void warm_start(const TreeRun<S>& run, const JointConstraint<S>* joints, const JointStep<S>& step) {
    const Memory m = Memory::of(run.memory, run.shape);
    Base::gather_velocities(run, m);
    Base::factorise(run, m, joints, step);
    for (const std::uint32_t j : run.shape.given) push(run.shape.joints[j], m, m.joints[j], load(m.joints[j].impulse));
    Base::scatter_velocities(run, m);
  }

  template <bool Relax> static void solve(const TreeRun<S>& run, const JointStep<S>& step) {
    const Memory m = Memory::of(run.memory, run.shape);
    const std::size_t count = run.shape.joints.size();
    Base::gather_velocities(run, m);
    for (std::size_t j = 0; j < count; ++j) find_right_side<Relax>(run.shape.joints[j], m, m.joints[j], step);
    for (std::size_t j = 0; j < count; ++j) substitute_up(run.shape, j, m);
    for (std::size_t j = count; j-- > 0;) substitute_down(run.shape, j, m);
    Base::scatter_velocities(run, m);
  }

 private:
  static ISO_INLINE Vec3<V> times(L a, Vec3<V> v) { return {times(a, v.x), times(a, v.y), times(a, v.z)}; }
  static ISO_INLINE Vec3<V> times(const Mat3<L>& a, Vec3<V> v) {
    return {round_to<V>(dot_sum(a.rows[0], v)), round_to<V>(dot_sum(a.rows[1], v)), round_to<V>(dot_sum(a.rows[2], v))};
  }
  /// As the functions of these names in joint_rows.hpp.
  static ISO_INLINE Vec3<V> impulses(const Mat3<L>& a, Vec3<V> v) {
    const Velocity<S> most = most_joint_impulse<S>();
    return {round_within<V>(dot_sum(a.rows[0], v), most), round_within<V>(dot_sum(a.rows[1], v), most),
            round_within<V>(dot_sum(a.rows[2], v), most)};
  }
  static ISO_INLINE Vec3<V> less_moved(Vec3<V> right, const Mat3<L>& a, Vec3<V> v) {
    return {with_headroom(right.x - round_with_headroom<V>(dot_sum(a.rows[0], v))),
            with_headroom(right.y - round_with_headroom<V>(dot_sum(a.rows[1], v))),
            with_headroom(right.z - round_with_headroom<V>(dot_sum(a.rows[2], v)))};
  }
  static ISO_INLINE Vec3<V> bounded(Vec3<V> v, Velocity<S> most) {
    const V high = V::broadcast(most), low = -high;
    return {clamp(v.x, low, high), clamp(v.y, low, high), clamp(v.z, low, high)};
  }

  static ISO_INLINE void push(const TreeJoint& of, Memory m, const Joint& joint, Vec3<V> impulse) {
    if (of.a_moves) {
      Body& body = m.bodies[of.body_a];
      const Vec3<V> p = times(L::load(joint.share_a), impulse);
      store(load(body.linear) - p, body.linear);
      store(load(body.angular) - times(load(joint.turn_a), p), body.angular);
    }
    if (of.b_moves) {
      Body& body = m.bodies[of.body_b];
      const Vec3<V> p = times(L::load(joint.share_b), impulse);
      store(load(body.linear) + p, body.linear);
      store(load(body.angular) + times(load(joint.turn_b), p), body.angular);
    }
  }
  /// speed_along() of joint_rows.hpp: v + w x r of b less that of a.
  static ISO_INLINE Vec3<V> speed(const TreeJoint& of, Memory m, const Joint& joint) {
    const Body& a = m.bodies[of.body_a];
    const Body& b = m.bodies[of.body_b];
    const Vec3<L> ra = load(joint.arm_a), rb = load(joint.arm_b);
    const Vec3<V> wa = load(a.angular), wb = load(b.angular);
    const Vec3<V> turning = {
        round_to<V>(product(rb.z, wb.y) - product(rb.y, wb.z) - product(ra.z, wa.y) + product(ra.y, wa.z)),
        round_to<V>(product(rb.x, wb.z) - product(rb.z, wb.x) - product(ra.x, wa.z) + product(ra.z, wa.x)),
        round_to<V>(product(ra.x, wa.y) - product(ra.y, wa.x) - product(rb.x, wb.y) + product(rb.y, wb.x))};
    return load(b.linear) - load(a.linear) + turning;
  }

  /// Of K lambda = -(speed + bias), for velocities as they are before anything of this pass is applied.
  template <bool Relax>
  static ISO_INLINE void find_right_side(const TreeJoint& of, Memory m, Joint& joint, const JointStep<S>& step) {
    Vec3<V> right = -(speed(of, m, joint) + load(joint.curve));
    if constexpr (!Relax) {
      right -= bounded(times(number(step.softness.bias_rate), load(joint.error)), detail::kJointPushSpeed<S>);
      if (of.closes_loop) right -= times(number(detail::kClosingCompliance<S>), load(joint.impulse));
    }
    store(right, joint.right);
  }
  static ISO_INLINE void substitute_up(const TreeShape& shape, std::size_t j, Memory m) {
    const TreeJoint& of = shape.joints[j];
    Joint& joint = m.joints[j];
    const Vec3<V> right = impulses(load(joint.inverse), load(joint.right));
    store(right, joint.right);
    for (std::uint32_t l = of.first_link; l < of.first_link + of.link_count; ++l) {
      Joint& to = m.joints[shape.links[l].to];
      store(less_moved(load(to.right), load(m.links[l].down), right), to.right);
    }
  }
  static ISO_INLINE void substitute_down(const TreeShape& shape, std::size_t j, Memory m) {
    const TreeJoint& of = shape.joints[j];
    Joint& joint = m.joints[j];
    Vec3<V> change = load(joint.right);
    for (std::uint32_t l = of.first_link; l < of.first_link + of.link_count; ++l) {
      change = less_moved(change, load(m.links[l].up), load(m.joints[shape.links[l].to].right));
    }
    store(change, joint.right);
    const Vec3<V> old = load(joint.impulse);
    const Vec3<V> impulse = bounded(old + change, most_joint_impulse<S>());
    store(impulse, joint.impulse);
    push(of, m, joint, impulse - old);
  }
};

template <class S, int W, class Isa> constexpr TreeKernels<S> make_tree_kernels(const char* name) {
  using Kernel = TreeKernel<S, W, Isa>;
  return {name,
          W,
          &Kernel::prepare,
          &Kernel::store_impulses,
          &Kernel::warm_start,
          &Kernel::template solve<false>,
          &Kernel::template solve<true>};
}

}  // namespace

/// The kernels of one lane of a scalar: any machine.
#define ISO_DEFINE_SCALAR_TREE_KERNELS(S) \
  ISO_DEFINE_KERNEL_TABLE(TreeKernels<S>, Simd::scalar, make_tree_kernels<S, 1, isa::Portable>("scalar"))

}  // namespace isostep
