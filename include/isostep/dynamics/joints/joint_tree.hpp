// JointTrees: all joints of a chain, ragdoll or bridge solved at once by elimination from the leaves, in linear time.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/aligned_bytes.hpp"
#include "isostep/core/disjoint_sets.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/dynamics/joints/tree_kernels.hpp"

namespace isostep {

/// The joints that are solved at once: all that form trees, or only trees that have a drive and close no loop.
enum class JointOrder : std::uint32_t { trees, driven_trees };

/// Source:  Baraff 1996, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH: a sparse factorisation ordered from
///          the leaves of a tree inwards has no fill-in. Differs: joints are the unknowns, bodies the couplings.
/// Why:     one joint after another, fifty links need thousands of passes to feel a weight at their end. Here one pass
///          is enough, whatever the ratio of masses, and nothing has to be soft.
/// Symbols: lambda_i = impulse over joint i's reduced mass, three to a block; K_ij = share_j A_ij couples blocks i and
///          j at the body they share, A_ij = A_ji^T. Elimination keeps diagonal blocks symmetric and near one.
/// Error:   S6 of the scenes (50 links, a weight of 100) at 4 sub-steps: worst separation 3.4 mm swinging, 3 um
///          hanging. Solved one after another, 91 mm (two sweeps) and 35 mm. tests/unit/dynamics/joints_test.cpp.
/// Limits:  loose, solved by themselves before the trees: a joint that closes a loop of bodies, one that would be the
///          25th block at one body, one that would tie trees that hang in more than four places, and all joints of a
///          tree whose mass over their least reduced mass is more than the format resolves (64 for Q16.16, 8192 for
///          float). The world is no body: both ends of a bridge may hang on it. The end that closes that loop yields a
///          little, since what it asks for may be held already. While tension is taken implicitly (stiffen) joints
///          conserve momentum, not angular momentum.
/// Drives:  rows of their joint's blocks, by tree_laws.inl. While one is off its piece of the law the pass begins again
///          with new factors, see kMostPieceChanges. A block of inactive drives alone asks for nothing and is left out.
///          Limits of an angle that no speed of a sub-step reaches (tree_stops.inl) cost it one look at orientations.
///          Loose joints are as soft as JointStep::softness, trees are rigid.
/// Order:   trees, elimination, turns and loops follow from the order of joints and rows alone.
/// Batches: TreeKernels solve trees, as many of one shape at once as they are wide. A loose joint is a tree of one, in
///          the first turn in which no other has its bodies. Loose joints, turn by turn, and trees that share a body
///          with them form one more batch. Batches write no body in common: threads may warm start and solve them in
///          parallel, in any order.
template <class S> class JointTrees {
 public:
  /// Plans the trees once a step, after its joints are prepared. `wide` is not null if there are joints.
  void plan(std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies, const TreeKernels<S>* wide,
            JointOrder order = JointOrder::trees);
  ISO_INLINE std::uint32_t batch_count() const {
    return static_cast<std::uint32_t>(batches_.size()) + (loose_.empty() ? 0u : 1u);
  }
  /// A sub-step takes the joints' state and warm starts, solves with bias and, after positions moved, relaxes.
  void warm_start(std::uint32_t batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step);
  void solve(std::uint32_t batch, const JointStep<S>& step, bool relax);
  /// Stores impulses in the joints once a step, after the last sub-step.
  void store(std::uint32_t batch, std::span<JointConstraint<S>> joints);

 private:
  /// The most blocks at a body: twelve joints of two. Elimination links all blocks of a body with each other, and costs
  /// the third power of their number: joints on one body alone take 20 times as long with 24 blocks as with 8.
  static constexpr std::uint32_t kMaxBlocksAtBody = 24;
  /// The most joints by which a tree that other joints tie hangs on the world: four chains of a table. A curtain of 100
  /// columns is trees of four then, and not one; the one takes twice as long and holds no better.
  static constexpr std::uint32_t kMaxAnchors = 4;
  /// Sweeps over the loose joints. A second takes S6's worst separation from 0.6 m to 0.09, four to 0.087.
  static constexpr int kLooseSweeps = 2;
  /// Relaxations of loose joints and of the trees that they connect. With too few, the speed that closed their errors
  /// stays. After one, a hanging grid of 10 by 10 bodies still swings at 10 m/s two seconds later.
  static constexpr int kLooseRelaxations = 4;

  /// A block of a joint, in order of elimination. Its links lead to blocks that are eliminated later.
  struct Node {
    std::uint32_t joint, block;
    std::uint32_t first_link, link_count;
  };
  /// A tree: a list of joints, linked by next_.
  struct Tree {
    std::uint64_t hash;    // of its joints' ends
    std::uint32_t active;  // of its joints, the first 32: those with a drive that is not free
    bool odd;              // shares a body with loose joints
    std::uint32_t turn;    // n: a loose joint, in the n-th turn; 0: a tree
    std::uint32_t first, last, joint_count, body_count;
  };
  /// The ends of a joint by the body numbers of its tree, and its rows: equal lists of them are equal shapes.
  struct Ends {
    std::uint32_t a, b;
    std::uint32_t layout;
    bool a_moves, b_moves, closes_loop;
  };
  struct HashOfTree {
    ISO_INLINE std::uint64_t operator()(const Tree& tree) const { return tree.hash; }
  };
  struct TurnOfTree {
    ISO_INLINE std::uint64_t operator()(const Tree& tree) const { return tree.turn; }
  };
  struct ActiveOfTree {
    ISO_INLINE std::uint64_t operator()(const Tree& tree) const { return tree.active; }
  };
  /// The beginnings and lengths of a shape's lists.
  struct Shape {
    std::uint32_t first_joint, joint_count, first_node, node_count, first_link, link_count, first_drive, drive_count,
        first_body, body_count, row_blocks, stops, laws;
    bool written;  // joints write rows: it has more than points
    bool soft;
    bool follows;
  };
  struct Batch {
    const TreeKernels<S>* kernels;
    std::uint32_t shape;
    std::uint32_t first_joint, first_row, first_idle, first_drive;  // in lane_joints_, lane_rows_, lane_bits_, drives_
    std::uint32_t lanes;
    std::size_t offset;  // [bytes] in memory_
  };

  // joint_tree_plan.inl
  void find_trees(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies, JointOrder order);
  /// The softest entry after a tree's elimination is near the least reduced mass of its joints over its whole mass.
  static ISO_INLINE bool is_too_heavy(S mass, S lightest) { return lightest < mass * detail::kTreeCompliance<S>; }
  void add_joint(const JointConstraint<S>& joint, const SolverBodies<S>& bodies, std::uint32_t j);
  void weigh_sets(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies, JointOrder order);
  void place_in_tree(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies, std::uint32_t j);
  void list_joints_of_bodies(std::span<const JointConstraint<S>> joints);
  void eliminate(std::span<const JointConstraint<S>> joints, std::span<const std::uint32_t> some);
  void add_nodes(std::span<const JointConstraint<S>> joints, std::uint32_t j, std::span<const std::uint32_t> others);

  // joint_tree_batches.inl
  void gather_trees(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies);
  void gather_loose(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies);
  void add_to_tree(const JointConstraint<S>& joint, const SolverBodies<S>& bodies, std::uint32_t j, Tree& tree);
  bool same_shape(const Tree& a, const Tree& b) const;
  void make_batches(std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies, const TreeKernels<S>& wide);
  void prepare_batch(const Batch& batch, std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies);
  void add_shape(std::span<const JointConstraint<S>> joints, const Tree& tree);
  void add_shape_node(const JointConstraint<S>& joint, const Node& node, Shape& shape);
  void add_batch(std::span<const JointConstraint<S>> joints, std::span<const Tree> trees, const TreeKernels<S>& kernels,
                 std::size_t offset);
  TreeShape shape_of(const Shape& shape) const;
  TreeRun<S> run_of(const Batch& batch, SolverBodies<S>* bodies);

  // joint_tree_stops.inl
  void set_stops(const Batch& batch, std::span<JointConstraint<S>> joints);
  void set_drives(const Batch& batch, std::span<const JointConstraint<S>> joints);

  void write_rows(const Batch& batch, const TreeRun<S>& run, std::span<JointConstraint<S>> joints,
                  const JointStep<S>& step);
  void write_drive(const Batch& batch, const TreeRun<S>& run, std::uint32_t d, std::uint32_t which,
                   std::span<const JointConstraint<S>> joints, const JointStep<S>& step);

  // joint_tree.inl
  void linearise(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step);
  template <class Act> void each_loose_end(const SolverBodies<S>& bodies, bool all, const Act& act);
  void share_tension(const SolverBodies<S>& bodies);
  void warm_start(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step);
  void solve(const Batch& batch, const JointStep<S>& step, bool relax);
  void store(const Batch& batch, std::span<JointConstraint<S>> joints);

  DisjointSets sets_;
  std::vector<std::uint32_t> loose_;    // joints that are solved by themselves
  std::vector<std::uint8_t> role_;      // of each joint
  std::vector<std::uint32_t> anchors_;  // of each set of bodies: joints that hang it on the world
  std::vector<S> set_mass_;             // [kg] of each set of bodies, up to the limit
  std::vector<S> set_lightest_;         // [kg] least reduced mass of its joints
  std::vector<std::uint8_t> asked_;     // of each set of bodies: its joints are solved at once
  std::vector<std::uint32_t> degree_;   // of each row: tree joints not yet eliminated
  std::vector<std::uint32_t> blocks_;   // of each row
  std::vector<std::uint32_t> first_;    // of each row, in at_body_
  std::vector<std::uint32_t> at_body_;  // tree joints of each row
  std::vector<std::uint32_t> queue_;
  std::vector<std::uint32_t> node_of_;  // of joint * 2 + block
  std::vector<std::uint64_t> turns_;    // of each row: those of its loose joints, one bit each
  std::vector<S> pull_;                 // [m^2] of each row: by how much its loose joints pull
  std::vector<Mat3<S>> tension_;        // [m^2] of each row that they make taut: geometric stiffness h^2 / mass
  std::vector<Node> nodes_;             // of one tree, in order of elimination
  std::vector<std::uint32_t> links_;    // nodes that they lead to

  std::vector<std::uint8_t> odd_;           // of each set of bodies: loose joints touch it
  std::vector<std::uint32_t> tree_of_set_;  // in trees_
  std::vector<std::uint32_t> local_;        // of each row: its number in its tree
  std::vector<std::uint32_t> next_;         // of each joint: the next of its tree
  std::vector<Ends> ends_;                  // of each joint
  std::vector<Tree> trees_, sorted_trees_;
  std::vector<std::uint32_t> listed_;  // joints of one tree
  std::vector<Shape> shapes_;
  std::vector<TreeJoint> shape_joints_;
  std::vector<TreeNode> shape_nodes_;
  std::vector<TreeLink> shape_links_;
  std::vector<TreeDrive> shape_drives_;
  std::vector<TreeBody> shape_bodies_;
  std::vector<std::uint32_t> shape_given_;
  std::vector<Batch> batches_, odd_batches_, loose_batches_;
  std::vector<std::uint32_t> lane_joints_, lane_rows_;
  std::vector<std::uint32_t> lane_bits_;  // of each batch: idle of its nodes, clear and stale of its joints
  std::vector<DriveLanes> drives_;        // of each batch's drives
  AlignedBytes memory_;
};

}  // namespace isostep
