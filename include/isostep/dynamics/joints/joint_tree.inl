// Bodies of joint_tree.hpp that compute: coupling, elimination, substitution.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_alone.inl"
#include "isostep/dynamics/joints/joint_tension.hpp"
#include "isostep/dynamics/joints/joint_tree_batches.inl"

namespace isostep {

template <class S>
void JointTrees<S>::couple(const Node& node, Link& link, std::span<const JointConstraint<S>> joints,
                           const SolverBodies<S>& bodies) const {
  const Node& other = nodes_[link.to];
  const JointConstraint<S>& i = joints[node.joint];
  const JointConstraint<S>& j = joints[other.joint];
  const Mat3<S> zero = Mat3<S>::diagonal(Vec3<S>::zero());
  link.up = zero;
  link.down = zero;
  for (const bool i_is_a : {true, false}) {
    const std::uint32_t row = i_is_a ? i.row_a : i.row_b;
    if (!bodies.moves(row)) continue;
    for (const bool j_is_a : {true, false}) {
      if ((j_is_a ? j.row_a : j.row_b) != row) continue;
      const Mat3<S> k = detail::block_coupling(i.blocks[node.block], i_is_a, j.blocks[other.block], j_is_a);
      link.up = link.up + scaled_by(k, j_is_a ? j.share.a : j.share.b);
      link.down = link.down + scaled_by(transpose(k), i_is_a ? i.share.a : i.share.b);
    }
  }
}

template <class S> typename JointTrees<S>::Link& JointTrees<S>::link_between(std::uint32_t i, std::uint32_t j) {
  Link* link = &links_[nodes_[i].first_link];
  while (link->to != j) ++link;
  return *link;
}

/// Whether a block asks for nothing in this pass: all its rows are drives that push with a constant impulse or none.
template <class S> bool JointTrees<S>::is_idle(const JointConstraint<S>& joint, std::uint32_t block) const {
  if (joint.drive_count == 0 || block != joint.drives[0].block) return false;
  const bool alone = visit_joint_type(
      joint.properties.type, [](auto kind) ISO_INLINE_LAMBDA { return decltype(kind)::template Of<S>::kDrivesAlone; });
  if (!alone) return false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    if (!detail::is_constant(joint.drives[i], joint.drives[i].piece)) return false;
  }
  return true;
}

/// K = L D L^T by blocks: what node i's elimination leaves among the nodes it is linked to.
template <class S>
void JointTrees<S>::factor(const Elimination& tree, std::span<JointConstraint<S>> joints,
                           const SolverBodies<S>& bodies) {
  const std::span<Node> nodes(nodes_.data() + tree.first_node, tree.node_count);
  for (Node& node : nodes) {
    if (node.block == 0) couple_blocks(joints[node.joint]);
    node.idle = is_idle(joints[node.joint], node.block);
  }
  for (const Node& node : nodes) {
    if (node.idle) continue;
    for (std::uint32_t l = 0; l < node.link_count; ++l) couple(node, links_[node.first_link + l], joints, bodies);
  }
  for (const Node& node : nodes) {
    if (node.idle) continue;
    JointBlock<S>& block = joints[node.joint].blocks[node.block];
    const S softness = node.closes_loop ? detail::kClosingCompliance<S> : detail::kBlockCompliance<S>;
    block.inverse = invert_block(block, softness);
    const std::span<Link> links(links_.data() + node.first_link, node.link_count);
    for (Link& link : links) link.up = block.inverse * link.up;
    for (const Link& j : links) {
      if (nodes_[j.to].idle) continue;
      for (const Link& k : links) {
        if (nodes_[k.to].idle) continue;
        const Mat3<S> left = j.down * k.up;
        if (j.to == k.to) {
          subtract(joints[nodes_[j.to].joint].blocks[nodes_[j.to].block].coupling, left);
        } else if (j.to < k.to) {
          subtract(link_between(j.to, k.to).up, left);
        } else {
          subtract(link_between(k.to, j.to).down, left);
        }
      }
    }
  }
}

/// A pulled arm turns back like a pendulum, of stiffness f.r about the axes across it.
template <class S> void JointTrees<S>::find_taut(std::span<const JointConstraint<S>> joints, const JointStep<S>& step) {
  const SolverBodies<S>& bodies = *step.bodies;
  taut_.clear();
  for (const std::uint32_t j : rest_) detail::add_tension(joints[j], bodies, step.h, tension_, taut_);
}

template <class S> void JointTrees<S>::stiffen(const SolverBodies<S>& bodies) {
  for (const std::uint32_t row : taut_) {
    kappa_[row] = detail::stiffened(bodies.mass[row].kappa, tension_[row]);
    tension_[row] = Mat3<S>::diagonal(Vec3<S>::zero());
  }
}

template <class S> void JointTrees<S>::warm_start_rest(std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  for (const std::uint32_t j : rest_) {
    JointConstraint<S>& joint = joints[j];
    linearise_joint(joint, step);
    curve_joint(joint, step);
    kappa_[joint.row_a] = step.bodies->mass[joint.row_a].kappa;
    kappa_[joint.row_b] = step.bodies->mass[joint.row_b].kappa;
  }
  find_taut(joints, step);
  stiffen(*step.bodies);
  for (const std::uint32_t j : rest_) weigh_joint(joints[j], kappa_[joints[j].row_a], kappa_[joints[j].row_b]);
  for (const std::uint32_t j : loose_) factor_joint(joints[j]);
  for (const Elimination& tree : eliminations_) factor(tree, joints, *step.bodies);
  for (const std::uint32_t j : rest_) apply_impulses(joints[j], step);
}

template <class S>
void JointTrees<S>::solve_rest(std::span<JointConstraint<S>> joints, const JointStep<S>& step, bool relax) {
  for (int sweep = 0; sweep < kLooseSweeps; ++sweep) {
    for (const std::uint32_t j : loose_) solve_joint(joints[j], step, relax);
  }
  for (const Elimination& tree : eliminations_) solve_tree(tree, joints, step, relax);
}

/// With drives on the pieces where they are; then anew as long as one is off its piece.
template <class S>
void JointTrees<S>::solve_tree(const Elimination& tree, std::span<JointConstraint<S>> joints, const JointStep<S>& step,
                               bool relax) {
  const std::span<const std::uint32_t> driven(driven_.data() + tree.first_driven, tree.driven_count);
  const std::span<const Node> nodes(nodes_.data() + tree.first_node, tree.node_count);
  const auto each_joint = [&](const auto& act) {
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].block == 0) act(joints[nodes[i].joint], starts_[tree.first_node + i]);
    }
  };
  if (!driven.empty()) {
    each_joint([&](const JointConstraint<S>& joint, JointStart<S>& start) { start = start_of(joint, *step.bodies); });
  }
  for (int changes = 0;; ++changes) {
    find_right_sides(tree, joints, step, relax);
    substitute(tree, joints, *step.bodies);
    bool off = false;
    const bool may_hold = changes < detail::kMostPieceChanges;
    for (const std::uint32_t j : driven) off = judge_drives(joints[j], step, relax, may_hold) || off;
    if (!off) return;
    each_joint(
        [&](JointConstraint<S>& joint, const JointStart<S>& start) { restart_joint(joint, start, *step.bodies); });
    for (const std::uint32_t j : driven) change_pieces(joints[j], step);
    factor(tree, joints, *step.bodies);
  }
}

template <class S>
void JointTrees<S>::substitute(const Elimination& tree, std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies) {
  const std::uint32_t end = tree.first_node + tree.node_count;
  for (std::uint32_t i = tree.first_node; i < end; ++i) {
    const Node& node = nodes_[i];
    if (node.idle) continue;
    right_[i] = impulses(joints[node.joint].blocks[node.block].inverse, right_[i]);
    for (std::uint32_t l = 0; l < node.link_count; ++l) {
      const Link& link = links_[node.first_link + l];
      if (!nodes_[link.to].idle) right_[link.to] = less_moved(right_[link.to], link.down, right_[i]);
    }
  }
  for (std::uint32_t i = end; i-- > tree.first_node;) {
    const Node& node = nodes_[i];
    for (std::uint32_t l = 0; !node.idle && l < node.link_count; ++l) {
      const Link& link = links_[node.first_link + l];
      if (!nodes_[link.to].idle) right_[i] = less_moved(right_[i], link.up, right_[link.to]);
    }
    // A joint's angular block comes just before its point in the order of elimination, so just after it here.
    JointConstraint<S>& joint = joints[node.joint];
    if (node.block + 1 < joint.block_count) continue;
    const Vec3<Velocity<S>> none = Vec3<Velocity<S>>::zero(), own = node.idle ? none : right_[i];
    const JointRows<S> change = node.block == 0 ? JointRows<S>{own, none} : JointRows<S>{right_[i + 1], own};
    push_joint(joint, change, Softness<S>::rigid(), bodies);
  }
}

/// Of K lambda = -(speed + bias), for velocities as they are before anything of this pass is applied.
template <class S>
void JointTrees<S>::find_right_sides(const Elimination& tree, std::span<const JointConstraint<S>> joints,
                                     const JointStep<S>& step, bool relax) {
  for (std::uint32_t i = tree.first_node; i < tree.first_node + tree.node_count; ++i) {
    const Node& node = nodes_[i];
    if (node.idle) continue;
    const JointConstraint<S>& joint = joints[node.joint];
    right_[i] = right_side(joint, node.block, gather(*step.bodies, joint.row_a, joint.row_b), step, relax);
    if (relax || !node.closes_loop) continue;
    const Vec3<Velocity<S>> impulse = joint.blocks[node.block].impulse;
    const auto yielded = [&](Velocity<S> old) { return scaled(detail::kClosingCompliance<S>, old); };
    right_[i] -= Vec3<Velocity<S>>{yielded(impulse.x), yielded(impulse.y), yielded(impulse.z)};
  }
}

}  // namespace isostep
