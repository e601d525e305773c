// Bodies of joint_tree.hpp that make batches: which trees have one shape, and which of them a kernel solves at once.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/joints/joint_tree_plan.inl"
#include "isostep/dynamics/joints/tree_lanes.hpp"

namespace isostep {

namespace detail {
/// Of a list, word by word: FNV-1a's step, with the high bits brought down.
ISO_INLINE constexpr std::uint64_t mix_hash(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3u;
  return hash ^ (hash >> 29);
}
}  // namespace detail

/// What a kernel cannot do: joints that hold more or less than a point, and joints that are solved by themselves.
template <class S>
void JointTrees<S>::mark_odd_sets(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies) {
  odd_.assign(degree_.size(), 0);
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    const JointConstraint<S>& joint = joints[j];
    const bool plain = holds_point(joint.properties.type) && joint.block_count == 1 && joint.drive_count == 0;
    if (role_[j] == detail::kIdle || (role_[j] != detail::kLoose && plain)) continue;
    for (const std::uint32_t row : {joint.row_a, joint.row_b}) {
      if (bodies.moves(row)) odd_[sets_.find(row)] = 1;
    }
  }
}

template <class S>
void JointTrees<S>::find_plain_trees(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies) {
  mark_odd_sets(joints, bodies);
  trees_.clear();
  tree_of_set_.assign(degree_.size(), detail::kNone);
  local_.assign(degree_.size(), detail::kNone);
  next_.resize(joints.size());
  ends_.resize(joints.size());
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (role_[j] < detail::kTree) continue;
    const std::uint32_t set = sets_.find(bodies.moves(joints[j].row_a) ? joints[j].row_a : joints[j].row_b);
    if (odd_[set] != 0) continue;
    std::uint32_t& tree = tree_of_set_[set];
    if (tree == detail::kNone) {
      tree = static_cast<std::uint32_t>(trees_.size());
      trees_.push_back({0, j, j, 0, 0});
    }
    add_to_tree(joints[j], bodies, j, trees_[tree]);
  }
}

template <class S>
void JointTrees<S>::add_to_tree(const JointConstraint<S>& joint, const SolverBodies<S>& bodies, std::uint32_t j,
                                Tree& tree) {
  const auto number = [&](std::uint32_t row, bool moves) {
    if (!moves) return tree.body_count++;
    if (local_[row] == detail::kNone) local_[row] = tree.body_count++;
    return local_[row];
  };
  const bool a_moves = bodies.moves(joint.row_a), b_moves = bodies.moves(joint.row_b);
  const std::uint32_t a = number(joint.row_a, a_moves);
  const std::uint32_t b = number(joint.row_b, b_moves);
  ends_[j] = {a, b, a_moves, b_moves, role_[j] == detail::kClosing};
  const std::uint64_t flags = (a_moves ? 1u : 0u) | (b_moves ? 2u : 0u) | (ends_[j].closes_loop ? 4u : 0u);
  tree.hash = detail::mix_hash(detail::mix_hash(tree.hash, std::uint64_t{a} << 32 | b), flags);
  next_[tree.last] = j;
  next_[j] = detail::kNone;
  tree.last = j;
  ++tree.joint_count;
}

template <class S> bool JointTrees<S>::same_shape(const Tree& a, const Tree& b) const {
  if (a.hash != b.hash || a.joint_count != b.joint_count) return false;
  for (std::uint32_t i = a.first, j = b.first; i != detail::kNone; i = next_[i], j = next_[j]) {
    const Ends &x = ends_[i], &y = ends_[j];
    if (x.a != y.a || x.b != y.b || x.a_moves != y.a_moves || x.b_moves != y.b_moves || x.closes_loop != y.closes_loop)
      return false;
  }
  return true;
}

template <class S>
void JointTrees<S>::make_batches(std::span<const JointConstraint<S>> joints, SolverBodies<S>& bodies,
                                 const TreeKernels<S>& wide) {
  shapes_.clear();
  shape_joints_.clear();
  shape_links_.clear();
  shape_bodies_.clear();
  shape_given_.clear();
  lane_joints_.clear();
  lane_rows_.clear();
  sorted_trees_.resize(trees_.size());
  const auto count = static_cast<std::uint32_t>(trees_.size());
  stable_sort(trees_.data(), sorted_trees_.data(), count, HashOfTree{});
  std::size_t bytes = 0;
  for (std::uint32_t first = 0; first < count;) {
    std::uint32_t end = first + 1;
    while (end < count && same_shape(trees_[first], trees_[end])) ++end;
    add_shape(joints, trees_[first]);
    while (first < end) {
      const std::uint32_t left = end - first;
      const TreeKernels<S>& kernels = left > 1 ? wide : *tree_kernels<S>(Simd::scalar);
      const std::uint32_t taken = min(left, static_cast<std::uint32_t>(kernels.width));
      add_batch(joints, std::span<const Tree>(trees_).subspan(first, taken), kernels);
      batches_.back().offset = bytes;
      bytes += static_cast<std::size_t>(kernels.width) * tree_bytes<S>(shape_of(shapes_.back()));
      bytes = (bytes + 63) / 64 * 64;
      first += taken;
    }
  }
  memory_.resize(bytes);
  for (const Batch& batch : batches_) batch.kernels->prepare(run_of(batch, &bodies), joints.data());
}

template <class S> void JointTrees<S>::add_shape(std::span<const JointConstraint<S>> joints, const Tree& tree) {
  listed_.clear();
  for (std::uint32_t j = tree.first; j != detail::kNone; j = next_[j]) listed_.push_back(j);
  nodes_.clear();
  links_.clear();
  eliminate(joints, listed_);
  Shape shape = {static_cast<std::uint32_t>(shape_joints_.size()), tree.joint_count,
                 static_cast<std::uint32_t>(shape_links_.size()),  static_cast<std::uint32_t>(links_.size()),
                 static_cast<std::uint32_t>(shape_bodies_.size()), tree.body_count};
  shapes_.push_back(shape);
  shape_bodies_.resize(shape.first_body + tree.body_count);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Ends& ends = ends_[node.joint];
    shape_joints_.push_back(
        {ends.a, ends.b, node.first_link, node.link_count, ends.a_moves, ends.b_moves, ends.closes_loop});
    shape_bodies_[shape.first_body + ends.a] = {i, true, ends.a_moves};
    shape_bodies_[shape.first_body + ends.b] = {i, false, ends.b_moves};
    for (std::uint32_t l = node.first_link; l < node.first_link + node.link_count; ++l) {
      const Ends& other = ends_[nodes_[links_[l].to].joint];
      const bool from_is_a = ends.a_moves && (ends.a == other.a || ends.a == other.b);
      shape_links_.push_back({links_[l].to, from_is_a, (from_is_a ? ends.a : ends.b) == other.a});
    }
  }
  for (const std::uint32_t j : listed_) shape_given_.push_back(node_of_[j * 2]);
}

template <class S>
void JointTrees<S>::add_batch(std::span<const JointConstraint<S>> joints, std::span<const Tree> trees,
                              const TreeKernels<S>& kernels) {
  const Shape& shape = shapes_.back();
  const auto width = static_cast<std::uint32_t>(kernels.width);
  Batch batch = {&kernels,
                 static_cast<std::uint32_t>(shapes_.size()) - 1,
                 static_cast<std::uint32_t>(lane_joints_.size()),
                 static_cast<std::uint32_t>(lane_rows_.size()),
                 0xffffffffu >> (32 - trees.size()),
                 0};
  lane_joints_.resize(lane_joints_.size() + std::size_t{shape.joint_count} * width);
  lane_rows_.resize(lane_rows_.size() + std::size_t{shape.body_count} * width);
  for (std::uint32_t lane = 0; lane < width; ++lane) {
    const Tree& tree = trees[lane < trees.size() ? lane : 0];
    const std::uint32_t* given = &shape_given_[shape.first_joint];
    for (std::uint32_t j = tree.first; j != detail::kNone; j = next_[j]) {
      role_[j] = detail::kBatched;
      lane_joints_[batch.first_joint + *given++ * width + lane] = j;
      lane_rows_[batch.first_row + ends_[j].a * width + lane] = joints[j].row_a;
      lane_rows_[batch.first_row + ends_[j].b * width + lane] = joints[j].row_b;
    }
  }
  batches_.push_back(batch);
}

template <class S> TreeShape JointTrees<S>::shape_of(const Shape& shape) const {
  return {{shape_joints_.data() + shape.first_joint, shape.joint_count},
          {shape_links_.data() + shape.first_link, shape.link_count},
          {shape_bodies_.data() + shape.first_body, shape.body_count},
          {shape_given_.data() + shape.first_joint, shape.joint_count}};
}
template <class S> TreeRun<S> JointTrees<S>::run_of(const Batch& batch, SolverBodies<S>* bodies) {
  return {shape_of(shapes_[batch.shape]),
          &lane_joints_[batch.first_joint],
          &lane_rows_[batch.first_row],
          batch.lanes,
          memory_.data() + batch.offset,
          bodies != nullptr ? bodies->velocity.data() : nullptr,
          bodies != nullptr ? bodies->mass.data() : nullptr};
}

template <class S>
void JointTrees<S>::warm_start(std::uint32_t batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  if (batch == batches_.size()) return warm_start_rest(joints, step);
  batches_[batch].kernels->warm_start(run_of(batches_[batch], step.bodies), joints.data(), step);
}
template <class S>
void JointTrees<S>::solve(std::uint32_t batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step,
                          bool relax) {
  if (batch == batches_.size()) return solve_rest(joints, step, relax);
  const TreeKernels<S>& kernels = *batches_[batch].kernels;
  if (relax) return kernels.relax(run_of(batches_[batch], step.bodies), step);
  kernels.solve(run_of(batches_[batch], step.bodies), step);
}
template <class S> void JointTrees<S>::store(std::uint32_t batch, std::span<JointConstraint<S>> joints) {
  if (batch < batches_.size()) batches_[batch].kernels->store(run_of(batches_[batch], nullptr), joints.data());
}

}  // namespace isostep
