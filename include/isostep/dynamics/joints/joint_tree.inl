// Bodies of joint_tree.hpp that compute: coupling, elimination, substitution.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint.inl"
#include "isostep/dynamics/joints/joint_tension.hpp"
#include "isostep/dynamics/joints/joint_tree_batches.inl"

namespace isostep {

namespace detail {
/// K_ij between blocks at one body, without the mass share of j.
template <class S>
ISO_INLINE Mat3<S> block_coupling(const JointBlock<S>& i, bool i_is_a, const JointBlock<S>& j, bool j_is_a) {
  if (i.point && j.point) {
    const auto angular = [&](int r) { return i_is_a ? i.rows[r].angular_a : i.rows[r].angular_b; };
    const auto turn = [&](int r) { return j_is_a ? j.rows[r].turn_a : j.rows[r].turn_b; };
    Mat3<S> p = point_coupling<S>({angular(0), angular(1), angular(2)}, {turn(0), turn(1), turn(2)});
    p = p + Mat3<S>::identity();
    return i_is_a == j_is_a ? p : Mat3<S>{{-p.rows[0], -p.rows[1], -p.rows[2]}};
  }
  Mat3<S> k;
  for (int r = 0; r < 3; ++r) {
    const JointRow<S>& row = i.rows[r];
    const Vec3<S> angular = i_is_a ? row.angular_a : row.angular_b;
    const auto with = [&](const JointRow<S>& other) {
      const S c = coupling(row.linear, angular, other.linear, j_is_a ? other.turn_a : other.turn_b);
      return i_is_a == j_is_a ? c : -c;
    };
    k.rows[r] = {with(j.rows[0]), with(j.rows[1]), with(j.rows[2])};
  }
  return k;
}
}  // namespace detail

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

/// K = L D L^T by blocks: what node i's elimination leaves among the nodes it is linked to.
template <class S> void JointTrees<S>::factor(std::span<JointConstraint<S>> joints, const SolverBodies<S>& bodies) {
  for (const Node& node : nodes_) {
    for (std::uint32_t l = 0; l < node.link_count; ++l) couple(node, links_[node.first_link + l], joints, bodies);
  }
  for (const Node& node : nodes_) {
    JointBlock<S>& block = joints[node.joint].blocks[node.block];
    const S softness = node.closes_loop ? detail::kClosingCompliance<S> : detail::kBlockCompliance<S>;
    block.inverse = invert_symmetric(block.coupling, softness);
    const std::span<Link> links(links_.data() + node.first_link, node.link_count);
    for (Link& link : links) link.up = block.inverse * link.up;
    for (const Link& j : links) {
      for (const Link& k : links) {
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
  for (const std::uint32_t j : rest_) {
    const JointConstraint<S>& joint = joints[j];
    if (joint.block_count == 0) continue;
    for (const bool is_a : {true, false}) {
      const std::uint32_t row = is_a ? joint.row_a : joint.row_b;
      if (!bodies.moves(row)) continue;
      const detail::Pull<S> pull = detail::pull_on(joint, is_a, step.h);
      if (!(pull.stiffness > S(0))) continue;
      if (tension_[row].rows[0].x + tension_[row].rows[1].y + tension_[row].rows[2].z == S(0)) taut_.push_back(row);
      tension_[row] = tension_[row] + detail::across(pull.axis, pull.stiffness);
    }
  }
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
    kappa_[joint.row_a] = step.bodies->mass[joint.row_a].kappa;
    kappa_[joint.row_b] = step.bodies->mass[joint.row_b].kappa;
  }
  find_taut(joints, step);
  stiffen(*step.bodies);
  for (const std::uint32_t j : rest_) weigh_joint(joints[j], kappa_[joints[j].row_a], kappa_[joints[j].row_b]);
  for (const std::uint32_t j : loose_) {
    for (std::uint32_t i = 0; i < joints[j].block_count; ++i) {
      joints[j].blocks[i].inverse = invert_symmetric(joints[j].blocks[i].coupling, detail::kBlockCompliance<S>);
    }
  }
  factor(joints, *step.bodies);
  for (const std::uint32_t j : rest_) {
    weigh_drives(joints[j]);
    apply_impulses(joints[j], *step.bodies);
  }
}

template <class S>
void JointTrees<S>::solve_rest(std::span<JointConstraint<S>> joints, const JointStep<S>& step, bool relax) {
  for (const std::uint32_t j : rest_) {
    if (joints[j].drive_count > 0) solve_drives(joints[j], step, relax);
  }
  for (int sweep = 0; sweep < kLooseSweeps; ++sweep) {
    for (const std::uint32_t j : loose_) solve_blocks(joints[j], step, relax);
  }
  find_right_sides(joints, step, relax);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    right_[i] = saturated_times(joints[node.joint].blocks[node.block].inverse, right_[i]);
    for (std::uint32_t l = 0; l < node.link_count; ++l) {
      const Link& link = links_[node.first_link + l];
      right_[link.to] -= times(link.down, right_[i]);
    }
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    for (std::uint32_t l = 0; l < node.link_count; ++l) {
      const Link& link = links_[node.first_link + l];
      right_[i] -= saturated_times(link.up, right_[link.to]);
    }
    JointConstraint<S>& joint = joints[node.joint];
    JointBlock<S>& block = joint.blocks[node.block];
    const Vec3<Velocity<S>> impulse = saturated_sum<S>(block.impulse, right_[i]);
    JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
    push(block, joint.share, impulse - block.impulse, m);
    scatter(*step.bodies, joint.row_a, joint.row_b, m);
    block.impulse = impulse;
  }
}

/// Of K lambda = -(speed + bias), for velocities as they are before anything of this pass is applied.
template <class S>
void JointTrees<S>::find_right_sides(std::span<const JointConstraint<S>> joints, const JointStep<S>& step, bool relax) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const JointConstraint<S>& joint = joints[node.joint];
    const JointBlock<S>& block = joint.blocks[node.block];
    right_[i] = -speed_along(block, gather(*step.bodies, joint.row_a, joint.row_b));
    if (relax) continue;
    right_[i] -= detail::block_bias(block, step.softness.bias_rate);
    if (node.closes_loop) {
      const auto yielded = [&](Velocity<S> impulse) { return scaled(detail::kClosingCompliance<S>, impulse); };
      right_[i] -= Vec3<Velocity<S>>{yielded(block.impulse.x), yielded(block.impulse.y), yielded(block.impulse.z)};
    }
  }
}

}  // namespace isostep
