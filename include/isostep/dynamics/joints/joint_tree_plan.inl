// Bodies of joint_tree.hpp that plan: which joints form trees, and in which order their blocks are eliminated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_tree.hpp"

namespace isostep {

namespace detail {
inline constexpr std::uint32_t kNone = 0xffffffffu;
enum JointRole : std::uint8_t { kIdle, kLoose, kTree, kClosing, kQueued, kDone };
}  // namespace detail

template <class S>
void JointTrees<S>::plan(std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies, const TreeKernels<S>* wide,
                         JointOrder order) {
  loose_.clear();
  batches_.clear();
  odd_batches_.clear();
  loose_batches_.clear();
  if (joints.empty()) return;
  find_trees(joints, bodies, order);
  gather_trees(joints, bodies);
  list_joints_of_bodies(joints);
  make_batches(joints, bodies, *wide);
}

template <class S>
void JointTrees<S>::find_trees(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies,
                               JointOrder order) {
  const std::size_t rows = bodies.mass.size();
  sets_.begin(rows);
  role_.assign(joints.size(), detail::kIdle);
  degree_.assign(rows, 0);
  blocks_.assign(rows, 0);
  anchors_.assign(rows, 0);
  set_mass_.resize(rows);
  set_lightest_.assign(rows, Limits<S>::mass());
  for (std::size_t row = 0; row < rows; ++row) set_mass_[row] = min(bodies.mass[row].mass, Limits<S>::mass());
  // Joints that hang on the world come first: of a loop through it the joint yields that ties two such sets together,
  // not an end that bears one of them.
  for (const bool hangs : {true, false}) {
    for (std::uint32_t j = 0; j < joints.size(); ++j) {
      const JointConstraint<S>& joint = joints[j];
      if (joint.holds && hangs == !(bodies.moves(joint.row_a) && bodies.moves(joint.row_b)))
        add_joint(joint, bodies, j);
    }
  }
  weigh_sets(joints, bodies, order);
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (role_[j] >= detail::kTree) place_in_tree(joints, bodies, j);
    if (role_[j] == detail::kLoose) loose_.push_back(j);
  }
}

/// Adds a joint to a tree, unless it closes a loop of bodies, meets too many others, or ties two sets that hang by
/// themselves into one that is too heavy or hangs in too many places: so a wide net falls apart into few columns each.
template <class S>
void JointTrees<S>::add_joint(const JointConstraint<S>& joint, const SolverBodies<S>& bodies, std::uint32_t j) {
  const bool a_moves = bodies.moves(joint.row_a), b_moves = bodies.moves(joint.row_b);
  bool fits = true;
  for (const std::uint32_t row : {joint.row_a, joint.row_b}) {
    if (bodies.moves(row) && blocks_[row] + joint.block_count > kMaxBlocksAtBody) fits = false;
  }
  const std::uint32_t a = a_moves ? sets_.find(joint.row_a) : 0, b = b_moves ? sets_.find(joint.row_b) : 0;
  if (a_moves && b_moves && a == b) fits = false;
  role_[j] = fits ? detail::kTree : detail::kLoose;
  if (!fits) return;
  const std::uint32_t a_hangs = a_moves ? anchors_[a] : 1, b_hangs = b_moves ? anchors_[b] : 1;
  const S mass = min((a_moves ? set_mass_[a] : S(0)) + (b_moves ? set_mass_[b] : S(0)), Limits<S>::mass());
  const S reduced =
      a_moves ? bodies.mass[joint.row_a].mass * joint.share.a : bodies.mass[joint.row_b].mass * joint.share.b;
  const S lightest = min(reduced, min(a_moves ? set_lightest_[a] : reduced, b_moves ? set_lightest_[b] : reduced));
  if (a_hangs > 0 && b_hangs > 0) {
    if (a_moves && b_moves && (is_too_heavy(mass, lightest) || a_hangs + b_hangs > kMaxAnchors)) {
      role_[j] = detail::kLoose;
      return;
    }
    role_[j] = detail::kClosing;
  }
  if (a_moves && b_moves) sets_.join(joint.row_a, joint.row_b);
  const std::uint32_t set = sets_.find(a_moves ? joint.row_a : joint.row_b);
  anchors_[set] = a_hangs + b_hangs;
  set_mass_[set] = mass;
  set_lightest_[set] = lightest;
  if (a_moves) blocks_[joint.row_a] += joint.block_count;
  if (b_moves) blocks_[joint.row_b] += joint.block_count;
}

/// Marks the trees that are solved at once.
template <class S>
void JointTrees<S>::weigh_sets(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies,
                               JointOrder order) {
  asked_.assign(blocks_.size(), order == JointOrder::trees ? 1 : 0);
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (role_[j] < detail::kTree || joints[j].drive_count == 0) continue;
    asked_[sets_.find(bodies.moves(joints[j].row_a) ? joints[j].row_a : joints[j].row_b)] = 1;
  }
  if (order == JointOrder::trees) return;
  // A tree that loose joints tie too is not solved at once: over a whole step each would throw off the other.
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (role_[j] != detail::kLoose) continue;
    for (const std::uint32_t row : {joints[j].row_a, joints[j].row_b}) {
      if (bodies.moves(row)) asked_[sets_.find(row)] = 0;
    }
  }
}

template <class S>
void JointTrees<S>::place_in_tree(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies,
                                  std::uint32_t j) {
  const bool a_moves = bodies.moves(joints[j].row_a), b_moves = bodies.moves(joints[j].row_b);
  const std::uint32_t set = sets_.find(a_moves ? joints[j].row_a : joints[j].row_b);
  if (asked_[set] == 0 || is_too_heavy(set_mass_[set], set_lightest_[set])) {
    role_[j] = detail::kLoose;
    return;
  }
  if (a_moves) ++degree_[joints[j].row_a];
  if (b_moves) ++degree_[joints[j].row_b];
}

template <class S> void JointTrees<S>::list_joints_of_bodies(std::span<const JointConstraint<S>> joints) {
  node_of_.assign(joints.size() * 2, 0);
  first_.assign(degree_.size() + 1, 0);
  for (std::size_t row = 0; row < degree_.size(); ++row) first_[row + 1] = first_[row] + degree_[row];
  at_body_.resize(first_.back());
  blocks_.assign(degree_.size(), 0);  // from here on: how many of at_body_ are filled
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (role_[j] < detail::kTree) continue;
    for (const std::uint32_t row : {joints[j].row_a, joints[j].row_b}) {
      if (degree_[row] == 0) continue;
      const std::uint32_t at = first_[row] + blocks_[row];
      at_body_[at] = j;
      ++blocks_[row];
    }
  }
}

/// Orders elimination from the leaves: a joint's turn comes when one of its bodies has no other joint left. A body that
/// does not move has degree 0. `some` is a whole tree, or one loose joint.
template <class S>
void JointTrees<S>::eliminate(std::span<const JointConstraint<S>> joints, std::span<const std::uint32_t> some) {
  nodes_.clear();
  links_.clear();
  queue_.clear();
  if (role_[some.front()] == detail::kLoose) {
    add_nodes(joints, some.front(), {});
  } else {
    for (const std::uint32_t j : some) {
      if (degree_[joints[j].row_a] <= 1 || degree_[joints[j].row_b] <= 1) {
        queue_.push_back(j);
        role_[j] = detail::kQueued;
      }
    }
  }
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::uint32_t j = queue_[head];
    const JointConstraint<S>& joint = joints[j];
    const bool a_is_leaf = degree_[joint.row_a] == 0 || (degree_[joint.row_b] > 0 && degree_[joint.row_a] == 1);
    const std::uint32_t parent = a_is_leaf ? joint.row_b : joint.row_a;
    const std::uint32_t leaf = a_is_leaf ? joint.row_a : joint.row_b;
    role_[j] = detail::kDone;
    add_nodes(joints, j, std::span(at_body_).subspan(first_[parent], first_[parent + 1] - first_[parent]));
    if (degree_[leaf] > 0) --degree_[leaf];
    --degree_[parent];
    if (degree_[parent] != 1) continue;
    for (std::uint32_t i = first_[parent]; i < first_[parent + 1]; ++i) {
      const std::uint32_t other = at_body_[i];
      if (role_[other] == detail::kQueued || role_[other] == detail::kDone) continue;
      queue_.push_back(other);
      role_[other] = detail::kQueued;
    }
  }
  for (std::uint32_t& to : links_) to = node_of_[to];
}

/// `others`: the joints at the body that stays, of which those that are not eliminated yet couple with this one.
template <class S>
void JointTrees<S>::add_nodes(std::span<const JointConstraint<S>> joints, std::uint32_t j,
                              std::span<const std::uint32_t> others) {
  const auto link_to = [&](std::uint32_t joint, std::uint32_t block) { links_.push_back(joint * 2 + block); };
  for (std::uint32_t block = joints[j].block_count; block-- > 0;) {  // angles first: small blocks stay small
    Node node = {j, block, static_cast<std::uint32_t>(links_.size()), 0};
    node_of_[j * 2 + block] = static_cast<std::uint32_t>(nodes_.size());
    if (block == 1) link_to(j, 0);
    for (const std::uint32_t other : others) {
      if (role_[other] == detail::kDone) continue;
      for (std::uint32_t b = 0; b < joints[other].block_count; ++b) link_to(other, b);
    }
    node.link_count = static_cast<std::uint32_t>(links_.size()) - node.first_link;
    nodes_.push_back(node);
  }
}

}  // namespace isostep
