// W trees at their present poses: the rows of their joints, and K = L D L^T of them. Part of tree_kernel.inl, with
// internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/row_factors.hpp"
#include "isostep/dynamics/joints/tree_couplings.inl"
#include "isostep/math/lanes_select.hpp"
#include "isostep/scalar/lanes_bounded.hpp"

namespace isostep {
namespace {

/// Factorises K of W trees. Symbols: D, K, lambda as in joint_tree.hpp.
template <class S, int W, class Isa> struct TreeFactoriser : TreeCoupler<S, W, Isa> {
  using Base = TreeCoupler<S, W, Isa>;
  using Base::load;
  using Base::number;
  using Base::store;
  using typename Base::Body;
  using typename Base::Joint;
  using typename Base::L;
  using typename Base::Link;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::Node;
  using typename Base::Rows;
  using typename Base::U;
  using typename Base::V;

  /// Computes the rows of joints for the present poses of bodies, and what joints feel of their tension.
  static ISO_INLINE void linearise(const TreeRun<S>& run, Memory m, const JointConstraint<S>* joints,
                                   const JointStep<S>& step) {
    Base::gather_rows(run, m, joints);
    const bool rapid = follow_masses(run, m, step.rapid);
    for (std::size_t j = 0; j < run.shape.joints.size(); ++j) linearise(run.shape, j, m, step, rapid);
    stiffen(run.shape, m);
  }
  static ISO_INLINE void set_turns(const TreeRun<S>& run, Memory m) {
    for (const TreeNode& node : run.shape.nodes) {
      if (!Base::is_clear(run, node)) Base::set_turns(run.shape, node, m);
    }
  }
  /// Factorises K for rows with unchanged turns, with drives on their present pieces.
  static ISO_INLINE void factorise(const TreeRun<S>& run, Memory m) {
    const TreeShape& shape = run.shape;
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      if (idles(run, n)) continue;
      const TreeNode& node = shape.nodes[n];
      Mat3<L> k = Base::self_coupling(node, m);
      if (node.drive_count > 0) Base::scale_self(shape, node, m, k);
      store(k, m.nodes[n].inverse);
      for (std::uint32_t l = node.first_link; l < node.first_link + node.link_count; ++l) {
        if (idles(run, shape.links[l].to)) continue;
        Mat3<L> up, down;
        Base::couple(shape, node, shape.links[l], m, up, down);
        store(up, m.links[l].up);
        store(down, m.links[l].down);
      }
    }
    for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
      if (!idles(run, n)) eliminate(run, n, m);
    }
  }
  /// Returns true if the node asks for nothing in any lane.
  static ISO_INLINE bool idles(const TreeRun<S>& run, std::size_t node) {
    return run.shape.nodes[node].may_idle && (run.idle[node] & Base::kAll) == Base::kAll;
  }
  /// Returns the lanes in which the node asks for nothing.
  static ISO_INLINE Mask idle_lanes(const TreeRun<S>& run, std::size_t node) { return Mask::from_bits(run.idle[node]); }

  template <class A> static ISO_INLINE V times(A a, V b) { return round_to<V>(product(a, b)); }

  static ISO_INLINE void place_bodies(const TreeRun<S>& run, Memory m, const JointConstraint<S>* joints,
                                      const BodyState<S>* states) {
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) {
      const TreeBody& of = run.shape.bodies[b];
      const S* centre[W];
      const Unit<S>* orientation[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) {
        const std::uint32_t row = run.rows[b * W + static_cast<std::size_t>(i)];
        const JointConstraint<S>& joint = joints[run.joints[of.joint * W + static_cast<std::size_t>(i)]];
        const Pose<S>& fixed = of.is_a ? joint.pose_a : joint.pose_b;
        centre[i] = row == 0 ? &fixed.position.x : &states[row - 1].centre.x;
        orientation[i] = row == 0 ? &fixed.orientation.x : &states[row - 1].orientation.x;
      }
      L c[4];  // the last is no coordinate
      U q[4];
      load_transposed<4>(centre, c);
      load_transposed<4>(orientation, q);
      store({c[0], c[1], c[2]}, m.bodies[b].centre);
      store(Base::matrix_of({q[0], q[1], q[2], q[3]}), m.bodies[b].rotation);
      L::zero().store(m.bodies[b].pull);
      if (run.shape.follows) Base::turn_since(m.bodies[b], {q[0], q[1], q[2], q[3]});
      if (run.shape.stops == 0 && !run.shape.follows) continue;
      for (int i = 0; i < 4; ++i) q[i].store(m.bodies[b].orientation[i]);
    }
  }

 private:
  /// Gathers the masses of spinning bodies, as BodyRows left them. Returns true if any body spins.
  static ISO_INLINE bool follow_masses(const TreeRun<S>& run, Memory m, Velocity<S> least) {
    bool some = false;
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) {
      const auto spins = less(V::broadcast(least), max_abs(load(m.bodies[b].angular)));
      if (!any(spins)) continue;
      some = true;
      Base::gather_mass(&run.rows[b * W], run.mass, m.bodies[b], spins);
    }
    return some;
  }
  /// Does curve_joint() of joint.inl.
  static ISO_INLINE Vec3<V> curve(const Body& a, Vec3<L> arm_a, const Body& b, Vec3<L> arm_b,
                                  const JointStep<S>& step) {
    const V fast = max(max_abs(load(a.angular)), max_abs(load(b.angular)));
    Mask bends = less(V::broadcast(step.rapid), fast) & less(fast, V::broadcast(step.fastest));
    const Vec3<V> of_a = curve_of(a, arm_a, step, bends), of_b = curve_of(b, arm_b, step, bends);
    return select(bends, of_b - of_a, {V::zero(), V::zero(), V::zero()});
  }
  /// Clears lanes of `bends` in which the arm turns too far.
  static ISO_INLINE Vec3<V> curve_of(const Body& body, Vec3<L> arm, const JointStep<S>& step, Mask& bends) {
    const Velocity<S> most = convert<Velocity<S>>(Limits<S>::speed());
    const auto across = [most](Vec3<V> w, Vec3<L> r) ISO_INLINE_LAMBDA {
      return Vec3<V>{round_within<V>(product(r.z, w.y) - product(r.y, w.z), most),
                     round_within<V>(product(r.x, w.z) - product(r.z, w.x), most),
                     round_within<V>(product(r.y, w.x) - product(r.x, w.y), most)};
    };
    const Vec3<V> w = load(body.angular), v = across(w, arm);
    const L half = number(S(0.5) * step.h);
    const Vec3<V> bent = across({times(half, w.x), times(half, w.y), times(half, w.z)},
                                {convert<L>(v.x), convert<L>(v.y), convert<L>(v.z)});
    const V furthest = round_within<V>(product(number(S(0.5)) * max_abs(arm), V::broadcast(step.fastest)), most);
    bends = bends & ~less(furthest, max_abs(v));
    const V push = V::broadcast(detail::kJointPushSpeed<S>);
    const auto part = [&](V x) ISO_INLINE_LAMBDA { return clamp(x, -push, push); };
    return {part(bent.x), part(bent.y), part(bent.z)};
  }

  /// Computes the arms, the gaps of points, and the pull of the last impulse at each arm: linearise_joint(),
  /// pull_on().
  static ISO_INLINE void linearise(const TreeShape& shape, std::size_t j, Memory m, const JointStep<S>& step,
                                   bool rapid) {
    const TreeJoint& of = shape.joints[j];
    const TreeNode& node = shape.nodes[of.node];
    Joint& joint = m.joints[j];
    Body& a = m.bodies[of.body_a];
    Body& b = m.bodies[of.body_b];
    const Vec3<L> arm_a = load(a.rotation) * load(joint.frame_a), arm_b = load(b.rotation) * load(joint.frame_b);
    store(arm_a, joint.arm_a);
    store(arm_b, joint.arm_b);
    if (node.is_point()) {
      const Vec3<L> between = (load(b.centre) - load(a.centre)) + (arm_b - arm_a);
      const L most = number(S(32) * step.h);
      const auto bound = [most](L e) ISO_INLINE_LAMBDA { return convert<V>(clamp(e, -most, most)); };
      store(Vec3<V>{bound(between.x), bound(between.y), bound(between.z)}, m.nodes[of.node].error);
      const Vec3<V> none = {V::zero(), V::zero(), V::zero()};
      store(rapid ? curve(a, arm_a, b, arm_b, step) : none, joint.curve);
    }
    const Vec3<V> impulse = pull_of(node, m, m.nodes[of.node]);
    const Lanes<Step<S>, W, Isa> length = Lanes<Step<S>, W, Isa>::broadcast(step.h);
    const auto pull = [&](Vec3<L> arm, L share, Body& body, S(&field)[W]) ISO_INLINE_LAMBDA {
      const L along = share * round_to<L>(dot_sum(arm, impulse));
      const L size = max(along, L::zero()) * length;
      size.store(field);
      (L::load(body.pull) + size).store(body.pull);
    };
    if (of.a_moves) pull(arm_a, -L::load(joint.share_a), a, joint.pull_a);
    if (of.b_moves) pull(arm_b, L::load(joint.share_b), b, joint.pull_b);
  }
  /// [m/s] Returns the pull of a node's last impulse on b, world.
  static ISO_INLINE Vec3<V> pull_of(const TreeNode& node, Memory m, const Node& block) {
    const Vec3<V> impulse = load(block.impulse);
    if (node.is_point()) return impulse;
    const Mat3<L> linear = load(m.rows[node.rows].linear);
    const auto along = [&](L x, L y, L z) ISO_INLINE_LAMBDA {
      return round_within<V>(product(x, impulse.x) + product(y, impulse.y) + product(z, impulse.z),
                             most_joint_impulse<S>());
    };
    return {along(linear.rows[0].x, linear.rows[1].x, linear.rows[2].x),
            along(linear.rows[0].y, linear.rows[1].y, linear.rows[2].y),
            along(linear.rows[0].z, linear.rows[1].z, linear.rows[2].z)};
  }

  // ---- tension, as JointTrees::find_taut() and stiffen() have it

  static ISO_INLINE bool taut(const Body& body) { return any(less(L::load(body.calm), L::load(body.pull))); }

  static ISO_INLINE void stiffen(const TreeShape& shape, Memory m) {
    bool some = false;
    for (std::size_t b = 0; b < shape.bodies.size(); ++b) {
      Body& body = m.bodies[b];
      store(load(body.kappa), body.felt);
      if (shape.soft || !shape.bodies[b].moves || !taut(body)) continue;
      some = true;
      for (S(&field)[W] : body.tension) L::zero().store(field);
    }
    if (!some) return;
    for (const std::uint32_t j : shape.given) {
      const TreeJoint& of = shape.joints[j];
      const Joint& joint = m.joints[j];
      if (of.a_moves) tighten(load(joint.arm_a), L::load(joint.pull_a), m.bodies[of.body_a]);
      if (of.b_moves) tighten(load(joint.arm_b), L::load(joint.pull_b), m.bodies[of.body_b]);
    }
    for (std::size_t b = 0; b < shape.bodies.size(); ++b) {
      if (shape.bodies[b].moves && taut(m.bodies[b])) stiffen(m.bodies[b]);
    }
  }
  /// Adds s (1 - n n^T) where s > 0.
  static ISO_INLINE void tighten(Vec3<L> arm, L s, Body& body) {
    const Mask pulls = less(L::zero(), s);
    if (!taut(body) || !any(pulls)) return;
    const Direction<L> n = direction_where(pulls, arm.x, arm.y, arm.z);
    const L parts[6] = {s - s * (n.x * n.x), -(s * (n.x * n.y)), -(s * (n.x * n.z)),
                        s - s * (n.y * n.y), -(s * (n.y * n.z)), s - s * (n.z * n.z)};
    ISO_UNROLL for (int i = 0; i < 6; ++i) {
      const L old = L::load(body.tension[i]);
      select(pulls, old + parts[i], old).store(body.tension[i]);
    }
  }
  static ISO_INLINE void stiffen(Body& body) {
    const Mat3<L> kappa = load(body.kappa), tension = load(body.tension);
    const auto square = [&](int i) ISO_INLINE_LAMBDA { return round_to<L>(dot_sum(kappa.rows[i], tension.rows[i])); };
    const L stiffness = square(0) + square(1) + square(2);
    const L limit = number(S(2) * detail::kTautLimit<S>), one = number(S(1));
    const Mask acts = less(limit, stiffness);
    if (!any(acts)) return;
    const L largest = max(kappa.rows[0].x, max(kappa.rows[1].y, kappa.rows[2].z));
    const L unit = quotient_where<L>(acts, one, largest);
    const L excess = one - quotient_where<L>(acts, limit, stiffness);
    Mat3<L> inertia = invert_symmetric(scaled_by(kappa, unit), number(S(0x1p-12)));
    inertia = inertia + scaled_by(scaled_by(tension, largest), excess);
    const Mat3<L> felt = scaled_by(invert_symmetric(inertia, L::zero()), largest);
    Mat3<L> chosen;
    ISO_UNROLL for (int i = 0; i < 3; ++i) chosen.rows[i] = select(acts, felt.rows[i], kappa.rows[i]);
    store(chosen, body.felt);
  }

  // ---- K

  static ISO_INLINE std::uint32_t link_between(const TreeShape& shape, std::uint32_t i, std::uint32_t j) {
    std::uint32_t l = shape.nodes[i].first_link;
    while (shape.links[l].to != j) ++l;
    return l;
  }
  static ISO_INLINE SymmetricFactors<L> factors_of(const TreeShape& shape, const TreeNode& node, const Mat3<L>& k) {
    const S softness =
        shape.joints[node.joint].closes_loop ? detail::kClosingCompliance<S> : detail::kBlockCompliance<S>;
    return node.is_point() ? factor_symmetric(k, number(softness)) : factor_rows(k, softness);
  }
  /// Eliminates node i from K = L D L^T, by blocks: updates the nodes that it is linked to.
  static ISO_INLINE void eliminate(const TreeRun<S>& run, std::size_t i, Memory m) {
    const TreeShape& shape = run.shape;
    const TreeNode& node = shape.nodes[i];
    const SymmetricFactors<L> factors = factors_of(shape, node, load(m.nodes[i].inverse));
    store(factors.inverse(), m.nodes[i].inverse);
    const std::uint32_t end = node.first_link + node.link_count;
    for (std::uint32_t l = node.first_link; l < end; ++l) {
      if (!idles(run, shape.links[l].to)) store(factors.solve(load(m.links[l].up)), m.links[l].up);
    }
    const Left left = {idle_lanes(run, i), node.may_idle && run.idle[i] != 0};
    for (std::uint32_t j = node.first_link; j < end; ++j) {
      const std::uint32_t to_j = shape.links[j].to;
      if (idles(run, to_j)) continue;
      const Mat3<L> down = load(m.links[j].down);
      for (std::uint32_t k = node.first_link; k < end; ++k) {
        const std::uint32_t to_k = shape.links[k].to;
        if (idles(run, to_k)) continue;
        const Mat3<L> up = load(m.links[k].up);
        if (to_j == to_k) {
          left.subtract_symmetric(m.nodes[to_j].inverse, down, up);
        } else if (to_j < to_k) {
          left.subtract(m.links[link_between(shape, to_j, to_k)].up, down * up);
        } else {
          left.subtract(m.links[link_between(shape, to_k, to_j)].down, down * up);
        }
      }
    }
  }
  /// Subtracts the update of an elimination, and +0 in lanes in which its node idles: -0 would turn a -0 into +0, and
  /// where all lanes idle nothing is subtracted.
  struct Left {
    Mask idle;
    bool some;

    ISO_INLINE void subtract(S (&field)[W], L p) const {
      if (some) p = select(idle, L::zero(), p);
      (L::load(field) - p).store(field);
    }
    ISO_INLINE void subtract(S (&field)[9][W], const Mat3<L>& p) const {
      for (int i = 0; i < 3; ++i) {
        subtract(field[3 * i], p.rows[i].x);
        subtract(field[3 * i + 1], p.rows[i].y);
        subtract(field[3 * i + 2], p.rows[i].z);
      }
    }
    /// Subtracts the upper triangle of a symmetric product.
    ISO_INLINE void subtract_symmetric(S (&field)[6][W], const Mat3<L>& p, const Mat3<L>& q) const {
      const Vec3<L> x = q.column(0), y = q.column(1), z = q.column(2);
      subtract(field[0], dot(p.rows[0], x));
      subtract(field[1], dot(p.rows[0], y));
      subtract(field[2], dot(p.rows[0], z));
      subtract(field[3], dot(p.rows[1], y));
      subtract(field[4], dot(p.rows[1], z));
      subtract(field[5], dot(p.rows[2], z));
    }
  };
};

}  // namespace
}  // namespace isostep
