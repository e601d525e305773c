// Copies joints and bodies to lanes and back, for the tree kernel. Part of tree_kernel.inl, with internal linkage like
// it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/joints/tree_kernels.hpp"
#include "isostep/dynamics/joints/tree_lanes.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep {
namespace {

/// Loads and stores vectors and matrices of lanes. Records transpose by whole registers, four or eight words a time.
template <class S, int W, class Isa> struct TreeGatherer {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using U = Lanes<Unit<S>, W, Isa>;
  using Mask = typename L::Mask;
  using Body = TreeBodyLanes<S, W>;
  using Joint = TreeJointLanes<S, W>;
  using Node = TreeNodeLanes<S, W>;
  using Rows = TreeRowLanes<S, W>;
  using Link = TreeLinkLanes<S, W>;
  using Drive = TreeDriveLanes<S, W>;
  using Law = TreeLawLanes<S, W>;
  using Stops = TreeStopLanes<S, W>;
  using Memory = TreeMemory<S, W>;

  template <class Wide, class One> static constexpr bool kLanesAndNothingBetween = sizeof(Wide) == W * sizeof(One);
  static_assert(
      kLanesAndNothingBetween<Body, TreeBodyLanes<S, 1>> && kLanesAndNothingBetween<Joint, TreeJointLanes<S, 1>> &&
      kLanesAndNothingBetween<Node, TreeNodeLanes<S, 1>> && kLanesAndNothingBetween<Rows, TreeRowLanes<S, 1>> &&
      kLanesAndNothingBetween<Link, TreeLinkLanes<S, 1>> && kLanesAndNothingBetween<Drive, TreeDriveLanes<S, 1>> &&
      kLanesAndNothingBetween<Law, TreeLawLanes<S, 1>> && kLanesAndNothingBetween<Stops, TreeStopLanes<S, 1>>);
  static_assert(sizeof(SolverMass<S>) == 10 * sizeof(S) && sizeof(Pose<S>) == 7 * sizeof(S));
  static_assert(offsetof(BodyState<S>, orientation) == offsetof(BodyState<S>, centre) + 3 * sizeof(S));

  static ISO_INLINE L number(S a) { return L::broadcast(a); }

  template <class T> static ISO_INLINE Vec3<Lanes<T, W, Isa>> load(const T (&field)[3][W]) {
    using A = Lanes<T, W, Isa>;
    return {A::load(field[0]), A::load(field[1]), A::load(field[2])};
  }
  template <class T> static ISO_INLINE Mat3<Lanes<T, W, Isa>> load(const T (&field)[9][W]) {
    using A = Lanes<T, W, Isa>;
    return {{{A::load(field[0]), A::load(field[1]), A::load(field[2])},
             {A::load(field[3]), A::load(field[4]), A::load(field[5])},
             {A::load(field[6]), A::load(field[7]), A::load(field[8])}}};
  }
  static ISO_INLINE Mat3<L> load(const S (&field)[6][W]) {
    const L xx = L::load(field[0]), xy = L::load(field[1]), xz = L::load(field[2]);
    const L yy = L::load(field[3]), yz = L::load(field[4]), zz = L::load(field[5]);
    return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
  }
  template <class T> static ISO_INLINE void store(const Vec3<Lanes<T, W, Isa>>& v, T (&field)[3][W]) {
    v.x.store(field[0]);
    v.y.store(field[1]);
    v.z.store(field[2]);
  }
  template <class T> static ISO_INLINE void store(const Mat3<Lanes<T, W, Isa>>& m, T (&field)[9][W]) {
    ISO_UNROLL for (int i = 0; i < 3; ++i) {
      m.rows[i].x.store(field[3 * i]);
      m.rows[i].y.store(field[3 * i + 1]);
      m.rows[i].z.store(field[3 * i + 2]);
    }
  }
  /// Stores the upper triangle.
  static ISO_INLINE void store(const Mat3<L>& m, S (&field)[6][W]) {
    m.rows[0].x.store(field[0]);
    m.rows[0].y.store(field[1]);
    m.rows[0].z.store(field[2]);
    m.rows[1].y.store(field[3]);
    m.rows[1].z.store(field[4]);
    m.rows[2].z.store(field[5]);
  }

  // ---- velocities, for the length of a pass

  static ISO_INLINE void gather_velocities(const TreeRun<S>& run, Memory m) {
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) {
      const Velocity<S>* rows[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) {
        rows[i] = &run.velocity[run.rows[b * W + static_cast<std::size_t>(i)]].linear.x;
      }
      V w[8];
      load_transposed<8>(rows, w);
      store({w[0], w[1], w[2]}, m.bodies[b].linear);
      store({w[4], w[5], w[6]}, m.bodies[b].angular);
    }
  }
  static ISO_INLINE void scatter_velocities(const TreeRun<S>& run, Memory m) {
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) {
      if (!run.shape.bodies[b].moves) continue;
      Velocity<S>* rows[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) {
        rows[i] = &run.velocity[run.rows[b * W + static_cast<std::size_t>(i)]].linear.x;
      }
      const Vec3<V> linear = load(m.bodies[b].linear), angular = load(m.bodies[b].angular);
      const V w[8] = {linear.x, linear.y, linear.z, V::zero(), angular.x, angular.y, angular.z, V::zero()};
      store_transposed<8>(rows, w, run.lanes);
    }
  }

  // ---- masses: once a step, and in those lanes that spin once a sub-step

  /// Gathers masses. Joints pull with tension T, the sum of s (1 - n n^T) over them, and tr(kappa T) decides. With k
  /// the largest moment of kappa it is at most 3 k times the sum of s, and kTautLimit asks for 4: below 1 / k the
  /// tension has no effect, and no direction n is needed. 64 resolutions allow for the rounding of eight joints.
  template <class Lane>
  static ISO_INLINE void gather_mass(const std::uint32_t* rows, const SolverMass<S>* masses, Body& body, Lane which) {
    const S* mass[W];
    const S* rest[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      mass[i] = &masses[rows[i]].mass;
      rest[i] = &masses[rows[i]].kappa.rows[1].z;
    }
    L k[8], r[4];
    load_transposed<8>(mass, k);
    load_transposed<4>(rest, r);
    const L xx = k[1], yy = k[5], zz = r[3];
    const Mat3<L> old = load(body.kappa), now = {{{xx, k[2], k[3]}, {k[4], yy, r[0]}, {k[7], r[2], zz}}};
    const auto part = [&](L x, L y) ISO_INLINE_LAMBDA { return select(which, x, y); };
    store(Mat3<L>{{{part(now.rows[0].x, old.rows[0].x), part(now.rows[0].y, old.rows[0].y),
                    part(now.rows[0].z, old.rows[0].z)},
                   {old.rows[1].x, part(now.rows[1].y, old.rows[1].y), part(now.rows[1].z, old.rows[1].z)},
                   {old.rows[2].x, old.rows[2].y, part(now.rows[2].z, old.rows[2].z)}}},
          body.kappa);
    const L largest = max(xx, max(yy, zz));
    const Mask turns = less(L::zero(), largest);
    const L calm = quotient_where<L>(turns, number(S(1)), largest) - number(S(64) * resolution<S>());
    select(which, select(turns, calm, number(highest<S>())), L::load(body.calm)).store(body.calm);
  }

  // ---- once a step

  static void prepare(const TreeRun<S>& run, const JointConstraint<S>* joints) {
    const Memory m = Memory::of(run.memory, run.shape);
    const Mask all = less(L::zero(), number(S(1)));
    for (std::size_t b = 0; b < run.shape.bodies.size(); ++b) gather_mass(&run.rows[b * W], run.mass, m.bodies[b], all);
    for (std::size_t j = 0; j < run.shape.joints.size(); ++j) prepare_joint(&run.joints[j * W], joints, m.joints[j]);
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) {
      const TreeNode& node = run.shape.nodes[n];
      const Velocity<S>* impulse[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) impulse[i] = &block_of(run, node, joints, i).error.z;
      V p[4];  // a word earlier, so that four end with the impulse
      load_transposed<4>(impulse, p);
      store({p[1], p[2], p[3]}, m.nodes[n].impulse);
    }
    for (std::size_t b = 0; run.shape.follows && b < run.shape.bodies.size(); ++b) {
      for (int i = 0; i < 4; ++i) U::zero().store(m.bodies[b].orientation[i]);  // turned by nothing
    }
    if (run.shape.stops == 0) return;
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) {
      if (!has_stops(run, run.shape.nodes[n])) continue;
      clear_rows(m.rows[run.shape.nodes[n].rows]);
      store({V::zero(), V::zero(), V::zero()}, m.nodes[n].error);
    }
  }
  static void store_impulses(const TreeRun<S>& run, JointConstraint<S>* joints) {
    const Memory m = Memory::of(run.memory, run.shape);
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) {
      const TreeNode& node = run.shape.nodes[n];
      const auto& impulse = m.nodes[n].impulse;
      for (int i = 0; i < W; ++i) {
        if (((run.lanes >> i) & 1u) == 0) continue;
        JointConstraint<S>& joint = joints[lane_joint(run, node.joint, i)];
        joint.blocks[node.of_angles ? 1 : 0].impulse = {impulse[0][i], impulse[1][i], impulse[2][i]};
        if (has_stops(run, node) || follows(run, node)) store_rows(run, node, m.rows[node.rows], i, joint);
      }
    }
  }

  // ---- once a sub-step

  /// Gathers rows and errors as their joints have written them.
  static ISO_INLINE void gather_rows(const TreeRun<S>& run, Memory m, const JointConstraint<S>* joints) {
    for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) {
      const TreeNode& node = run.shape.nodes[n];
      if (node.is_point() || has_stops(run, node)) continue;
      const std::uint32_t stale = run.stale[node.joint] & kAll;
      if (stale == 0) continue;
      const Mask which = Mask::from_bits(stale);
      Rows& rows = m.rows[node.rows];
      for (std::uint32_t r = 0; r < 3; ++r) gather_row(run, node, r, which, joints, rows);
      const Velocity<S>* errors[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) errors[i] = &block_of(run, node, joints, i).error.x;
      V e[4];  // the last is no error
      load_transposed<4>(errors, e);
      store(select(which, Vec3<V>{e[0], e[1], e[2]}, load(m.nodes[n].error)), m.nodes[n].error);
    }
  }
  static ISO_INLINE std::uint32_t lane_joint(const TreeRun<S>& run, std::uint32_t joint, int lane) {
    return run.joints[joint * W + static_cast<std::size_t>(lane)];
  }

  /// The lanes of a run, one bit each, with or without a tree.
  static constexpr std::uint32_t kAll = 0xffffffffu >> (32 - W);
  static ISO_INLINE bool has_stops(const TreeRun<S>& run, const TreeNode& node) {
    return node.of_angles && run.shape.joints[node.joint].stops != TreeJoint::kNoStops;
  }
  static ISO_INLINE bool follows(const TreeRun<S>& run, const TreeNode& node) {
    return node.of_angles && run.shape.joints[node.joint].follows;
  }
  /// Returns true if the node consists of limits that no lane reaches.
  static ISO_INLINE bool is_clear(const TreeRun<S>& run, const TreeNode& node) {
    return node.may_idle && run.clear[node.joint] == kAll;
  }

 private:
  /// Stores the rows that the sum of a joint's impulses on its bodies needs: joint_impulse.hpp.
  static ISO_INLINE void store_rows(const TreeRun<S>& run, const TreeNode& node, const Rows& rows, int lane,
                                    JointConstraint<S>& joint) {
    const auto row = [&](int r) ISO_INLINE_LAMBDA {
      return Vec3<S>{rows.angular_b[3 * r][lane], rows.angular_b[3 * r + 1][lane], rows.angular_b[3 * r + 2][lane]};
    };
    for (int r = 0; r < 3; ++r) joint.blocks[1].rows[r].angular_b = row(r);
    for (std::uint32_t d = node.first_drive; d < node.first_drive + node.drive_count; ++d) {
      const TreeDrive& drive = run.shape.drives[d];
      joint.drives[drive.index].row.angular_b = row(static_cast<int>(drive.place));
    }
  }
  /// Clears the rows of joints that are clear at the start of the step, so that all numbers are finite.
  static ISO_INLINE void clear_rows(Rows& rows) {
    const L zero = L::zero();
    for (int i = 0; i < 9; ++i) {
      zero.store(rows.linear[i]);
      zero.store(rows.angular_a[i]);
      zero.store(rows.angular_b[i]);
      zero.store(rows.turn_a[i]);
      zero.store(rows.turn_b[i]);
    }
  }
  static ISO_INLINE const JointBlock<S>& block_of(const TreeRun<S>& run, const TreeNode& node,
                                                  const JointConstraint<S>* joints, int lane) {
    return joints[lane_joint(run, node.joint, lane)].blocks[node.of_angles ? 1 : 0];
  }
  static ISO_INLINE void store_row(const L (&v)[4], const Mask& which, S (&field)[9][W], std::uint32_t row) {
    ISO_UNROLL for (int k = 0; k < 3; ++k) {
      S(&word)[W] = field[3 * row + static_cast<std::uint32_t>(k)];
      select(which, v[k], L::load(word)).store(word);
    }
  }
  /// Gathers a row of the node. A drive has its own row, in place of the one in the block.
  static ISO_INLINE void gather_row(const TreeRun<S>& run, const TreeNode& node, std::uint32_t r, const Mask& which,
                                    const JointConstraint<S>* joints, Rows& rows) {
    const TreeDrive* drive = nullptr;
    for (std::uint32_t d = node.first_drive; d < node.first_drive + node.drive_count; ++d) {
      if (run.shape.drives[d].place == r) drive = &run.shape.drives[d];
    }
    const S* from[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      const JointRow<S>& row = drive != nullptr ? joints[lane_joint(run, node.joint, i)].drives[drive->index].row
                                                : block_of(run, node, joints, i).rows[r];
      from[i] = &row.linear.x;
    }
    const auto part = [&](std::size_t offset, S(&field)[9][W]) ISO_INLINE_LAMBDA {
      const S* words[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) words[i] = from[i] + offset / sizeof(S);
      L v[4];  // the last is the part's that follows
      load_transposed<4>(words, v);
      store_row(v, which, field, r);
    };
    if (!node.of_angles) part(offsetof(JointRow<S>, linear), rows.linear);
    part(offsetof(JointRow<S>, angular_a), rows.angular_a);
    part(offsetof(JointRow<S>, angular_b), rows.angular_b);
  }
  static ISO_INLINE void prepare_joint(const std::uint32_t* lanes, const JointConstraint<S>* joints, Joint& joint) {
    const S* frame_a[W];
    const S* frame_b[W];
    const S* share[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      const JointConstraint<S>& j = joints[lanes[i]];
      frame_a[i] = &j.properties.frame_a.position.x;
      frame_b[i] = &j.properties.frame_b.position.x;
      share[i] = &j.share.a;
    }
    L a[4], b[4], s[4];
    load_transposed<4>(frame_a, a);
    load_transposed<4>(frame_b, b);
    load_transposed<4>(share, s);
    store({a[0], a[1], a[2]}, joint.frame_a);
    store({b[0], b[1], b[2]}, joint.frame_b);
    s[0].store(joint.share_a);
    s[1].store(joint.share_b);
  }
  static_assert(offsetof(JointBlock<S>, impulse) == offsetof(JointBlock<S>, error) + 3 * sizeof(S));
  static_assert(sizeof(MassShare<S>) == 2 * sizeof(S) &&
                offsetof(JointConstraint<S>, pose_a) == offsetof(JointConstraint<S>, share) + 2 * sizeof(S));
};

}  // namespace
}  // namespace isostep
