// Bodies of joint_tree.hpp that make batches: which trees have one shape, and which of them a kernel solves at once.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/dynamics/joints/joint_tree_plan.inl"
#include "isostep/dynamics/joints/joint_tree_stops.inl"
#include "isostep/dynamics/joints/tree_lanes.hpp"

namespace isostep {

namespace detail {
/// Adds a word to the hash of a list: a step of FNV-1a, with the high bits brought down.
ISO_INLINE constexpr std::uint64_t mix_hash(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3u;
  return hash ^ (hash >> 29);
}
/// Returns a joint's rows as far as kernels must know them: whether its first block is a point, whether there is a
/// second, which of both may idle, the row of each drive, whether all of them are stops, whether two sway, and whether
/// it follows.
inline constexpr std::uint32_t kStopsInLayout = 1u << 31, kSwaysInLayout = 1u << 30, kFollowsInLayout = 1u << 29;
template <class S> ISO_INLINE std::uint32_t layout_of(const JointConstraint<S>& joint) {
  const JointProperties<S>& p = joint.properties;
  std::uint32_t layout = (holds_point(p) ? 1u : 0u) | (joint.block_count > 1 ? 2u : 0u) | (is_free(p, 0) ? 4u : 0u) |
                         (is_free(p, 1) ? 8u : 0u) | joint.drive_count << 4;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    layout |= (3 * joint.drives[i].block + joint.drives[i].place) << (8 + 3 * i);
    if (joint.drives[i].sways) layout |= kSwaysInLayout;
  }
  if (has_stops(joint)) layout |= kStopsInLayout;
  if (follows(joint)) layout |= kFollowsInLayout;
  return layout;
}
}  // namespace detail

namespace detail {
/// Returns the narrowest kernels for so many trees at once, since lanes without a tree cost as much as others. `wide`
/// if there are more trees than it has lanes.
template <class S> ISO_INLINE const TreeKernels<S>& kernels_for(std::uint32_t trees, const TreeKernels<S>& wide) {
  const TreeKernels<S>* chosen = &wide;
  for (const Simd simd : {Simd::scalar, Simd::sse2, Simd::avx2, Simd::neon, Simd::wasm}) {
    const TreeKernels<S>* const kernels = tree_kernels<S>(simd);
    if (kernels == nullptr || static_cast<std::uint32_t>(kernels->width) < trees) continue;
    if (kernels->width < chosen->width) chosen = kernels;
  }
  return *chosen;
}
}  // namespace detail

template <class S>
void JointTrees<S>::gather_trees(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies) {
  odd_.assign(degree_.size(), 0);
  for (const std::uint32_t j : loose_) {
    for (const std::uint32_t row : {joints[j].row_a, joints[j].row_b}) {
      if (bodies.moves(row)) odd_[sets_.find(row)] = 1;
    }
  }
  trees_.clear();
  tree_of_set_.assign(degree_.size(), detail::kNone);
  local_.assign(degree_.size(), detail::kNone);
  next_.resize(joints.size());
  ends_.resize(joints.size());
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (role_[j] < detail::kTree) continue;
    const std::uint32_t set = sets_.find(bodies.moves(joints[j].row_a) ? joints[j].row_a : joints[j].row_b);
    std::uint32_t& tree = tree_of_set_[set];
    if (tree == detail::kNone) {
      tree = static_cast<std::uint32_t>(trees_.size());
      trees_.push_back({odd_[set], 0, odd_[set] != 0, 0, j, j, 0, 0});
    }
    add_to_tree(joints[j], bodies, j, trees_[tree]);
  }
  gather_loose(joints, bodies);
}

/// Makes a tree of each loose joint, in the first turn in which no other has its bodies.
template <class S>
void JointTrees<S>::gather_loose(std::span<const JointConstraint<S>> joints, const SolverBodies<S>& bodies) {
  constexpr std::uint32_t kTurns = 64;
  if (loose_.empty()) return;
  turns_.assign(degree_.size(), 0);
  std::uint32_t beyond = kTurns;
  for (const std::uint32_t j : loose_) {
    std::uint64_t taken = 0;
    for (const std::uint32_t row : {joints[j].row_a, joints[j].row_b}) taken |= bodies.moves(row) ? turns_[row] : 0;
    const std::uint32_t turn = ~taken != 0 ? static_cast<std::uint32_t>(std::countr_zero(~taken)) : beyond++;
    for (const std::uint32_t row : {joints[j].row_a, joints[j].row_b}) {
      local_[row] = detail::kNone;
      if (turn < kTurns) turns_[row] |= std::uint64_t{1} << turn;
    }
    trees_.push_back({0, 0, false, turn + 1, j, j, 0, 0});
    add_to_tree(joints[j], bodies, j, trees_.back());
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
  ends_[j] = {a, b, detail::layout_of(joint), a_moves, b_moves, role_[j] == detail::kClosing};
  const std::uint64_t flags = (a_moves ? 1u : 0u) | (b_moves ? 2u : 0u) | (ends_[j].closes_loop ? 4u : 0u);
  tree.hash = detail::mix_hash(detail::mix_hash(tree.hash, std::uint64_t{a} << 32 | b),
                               std::uint64_t{ends_[j].layout} << 3 | flags);
  bool acts = false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) acts = acts || joint.drives[i].piece != DrivePiece::free;
  if (acts && tree.joint_count < 32) tree.active |= 1u << tree.joint_count;
  next_[tree.last] = j;
  next_[j] = detail::kNone;
  tree.last = j;
  ++tree.joint_count;
}

template <class S> bool JointTrees<S>::same_shape(const Tree& a, const Tree& b) const {
  if (a.hash != b.hash || a.joint_count != b.joint_count || a.odd != b.odd || a.turn != b.turn) return false;
  for (std::uint32_t i = a.first, j = b.first; i != detail::kNone; i = next_[i], j = next_[j]) {
    const Ends &x = ends_[i], &y = ends_[j];
    const bool same = x.a == y.a && x.b == y.b && x.layout == y.layout && x.a_moves == y.a_moves &&
                      x.b_moves == y.b_moves && x.closes_loop == y.closes_loop;
    if (!same) return false;
  }
  return true;
}

/// Makes batches of trees of one shape. Trees in which the same drives act go together: a node that idles in all of
/// them costs nothing.
template <class S>
void JointTrees<S>::make_batches(std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies,
                                 const TreeKernels<S>& wide) {
  shapes_.clear();
  shape_joints_.clear();
  shape_nodes_.clear();
  shape_links_.clear();
  shape_drives_.clear();
  shape_bodies_.clear();
  shape_given_.clear();
  lane_joints_.clear();
  lane_rows_.clear();
  lane_bits_.clear();
  drives_.clear();
  sorted_trees_.resize(trees_.size());
  const auto count = static_cast<std::uint32_t>(trees_.size());
  stable_sort(trees_.data(), sorted_trees_.data(), count, ActiveOfTree{});
  stable_sort(trees_.data(), sorted_trees_.data(), count, HashOfTree{});
  if (!loose_.empty()) stable_sort(trees_.data(), sorted_trees_.data(), count, TurnOfTree{});
  std::size_t bytes = 0;
  for (std::uint32_t first = 0; first < count;) {
    std::uint32_t end = first + 1;
    while (end < count && same_shape(trees_[first], trees_[end])) ++end;
    add_shape(joints, trees_[first]);
    while (first < end) {
      const std::uint32_t left = end - first;
      const TreeKernels<S>& kernels = detail::kernels_for(left, wide);
      const std::uint32_t taken = min(left, static_cast<std::uint32_t>(kernels.width));
      add_batch(joints, std::span<const Tree>(trees_).subspan(first, taken), kernels, bytes);
      bytes += static_cast<std::size_t>(kernels.width) * tree_bytes<S>(shape_of(shapes_.back()));
      bytes = (bytes + 63) / 64 * 64;
      first += taken;
    }
  }
  memory_.resize(bytes);
  for (const Batch& batch : batches_) prepare_batch(batch, joints, bodies);
  for (const Batch& batch : odd_batches_) prepare_batch(batch, joints, bodies);
  for (const Batch& batch : loose_batches_) prepare_batch(batch, joints, bodies);
}

template <class S>
void JointTrees<S>::prepare_batch(const Batch& batch, std::span<JointConstraint<S>> joints, SolverBodies<S>& bodies) {
  batch.kernels->prepare(run_of(batch, &bodies), joints.data());
  if (shapes_[batch.shape].stops > 0) set_stops(batch, joints);
  set_drives(batch, joints);
}

template <class S> void JointTrees<S>::add_shape(std::span<const JointConstraint<S>> joints, const Tree& tree) {
  listed_.clear();
  for (std::uint32_t j = tree.first; j != detail::kNone; j = next_[j]) listed_.push_back(j);
  eliminate(joints, listed_);
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  Shape shape = {size(shape_joints_),
                 0,
                 size(shape_nodes_),
                 size(nodes_),
                 size(shape_links_),
                 size(links_),
                 size(shape_drives_),
                 0,
                 size(shape_bodies_),
                 tree.body_count,
                 0,
                 0,
                 0,
                 false,
                 tree.turn > 0,
                 false};
  shape_bodies_.resize(shape.first_body + tree.body_count);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const JointConstraint<S>& joint = joints[node.joint];
    add_shape_node(joint, node, shape);
    if (node.block != 0) continue;
    const Ends& ends = ends_[node.joint];
    const bool turns = joint.block_count > 1;
    const bool has_stops = (ends.layout & detail::kStopsInLayout) != 0;
    const std::uint32_t stops = has_stops ? shape.stops++ : TreeJoint::kNoStops;
    const bool follows = (ends.layout & detail::kFollowsInLayout) != 0;
    shape.follows = shape.follows || follows;
    shape_joints_.push_back({ends.a, ends.b, i, ends.a_moves, ends.b_moves, ends.closes_loop, turns, stops, follows});
    shape_bodies_[shape.first_body + ends.a] = {shape.joint_count, true, ends.a_moves};
    shape_bodies_[shape.first_body + ends.b] = {shape.joint_count, false, ends.b_moves};
    ++shape.joint_count;
  }
  for (const std::uint32_t j : listed_) shape_given_.push_back(shape_nodes_[shape.first_node + node_of_[j * 2]].joint);
  shapes_.push_back(shape);
}

/// Adds a node. A joint's block of angles comes just before that of places: it is a node of the joint that follows.
template <class S> void JointTrees<S>::add_shape_node(const JointConstraint<S>& joint, const Node& node, Shape& shape) {
  const Ends& ends = ends_[node.joint];
  const bool of_angles = node.block == 1, is_point = !of_angles && (ends.layout & 1u) != 0;
  TreeNode made = {shape.joint_count, is_point ? TreeNode::kNoRows : shape.row_blocks,
                   node.first_link,   node.link_count,
                   shape.drive_count, 0,
                   of_angles,         (ends.layout & (of_angles ? 8u : 4u)) != 0};
  if (!is_point) ++shape.row_blocks;
  shape.written = shape.written || !is_point;
  const auto number = static_cast<std::uint32_t>(shape_nodes_.size()) - shape.first_node;
  const bool has_stops = (ends.layout & detail::kStopsInLayout) != 0;
  for (std::uint32_t k = 0; k < joint.drive_count; ++k) {
    if (joint.drives[k].block != node.block) continue;
    const std::uint32_t law = has_stops ? TreeDrive::kNoLaw : shape.laws++;
    shape_drives_.push_back({shape.joint_count, number, joint.drives[k].place, k, law, joint.drives[k].sways});
    ++made.drive_count;
  }
  shape.drive_count += made.drive_count;
  shape_nodes_.push_back(made);
  for (std::uint32_t l = node.first_link; l < node.first_link + node.link_count; ++l) {
    const std::uint32_t to = nodes_[links_[l]].joint;
    const Ends& other = ends_[to];
    const bool from_is_a = ends.a_moves && (ends.a == other.a || ends.a == other.b);
    shape_links_.push_back({links_[l], from_is_a, (from_is_a ? ends.a : ends.b) == other.a, to == node.joint});
  }
}

template <class S>
void JointTrees<S>::add_batch(std::span<const JointConstraint<S>> joints, std::span<const Tree> trees,
                              const TreeKernels<S>& kernels, std::size_t offset) {
  const Shape& shape = shapes_.back();
  const auto width = static_cast<std::uint32_t>(kernels.width);
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  const Batch batch = {&kernels,
                       size(shapes_) - 1,
                       size(lane_joints_),
                       size(lane_rows_),
                       size(lane_bits_),
                       size(drives_),
                       0xffffffffu >> (32 - trees.size()),
                       offset};
  lane_joints_.resize(lane_joints_.size() + std::size_t{shape.joint_count} * width);
  lane_rows_.resize(lane_rows_.size() + std::size_t{shape.body_count} * width);
  lane_bits_.resize(lane_bits_.size() + shape.node_count + shape.joint_count, 0);
  lane_bits_.resize(lane_bits_.size() + shape.joint_count, 0xffffffffu);  // nothing is measured
  drives_.resize(drives_.size() + shape.drive_count, {});
  for (std::uint32_t lane = 0; lane < width; ++lane) {
    const Tree& tree = trees[lane < trees.size() ? lane : 0];
    const std::uint32_t* given = &shape_given_[shape.first_joint];
    for (std::uint32_t j = tree.first; j != detail::kNone; j = next_[j]) {
      lane_joints_[batch.first_joint + *given++ * width + lane] = j;
      lane_rows_[batch.first_row + ends_[j].a * width + lane] = joints[j].row_a;
      lane_rows_[batch.first_row + ends_[j].b * width + lane] = joints[j].row_b;
    }
  }
  (trees.front().turn > 0 ? loose_batches_ : trees.front().odd ? odd_batches_ : batches_).push_back(batch);
}

template <class S> TreeShape JointTrees<S>::shape_of(const Shape& shape) const {
  return {{shape_joints_.data() + shape.first_joint, shape.joint_count},
          {shape_nodes_.data() + shape.first_node, shape.node_count},
          {shape_links_.data() + shape.first_link, shape.link_count},
          {shape_drives_.data() + shape.first_drive, shape.drive_count},
          {shape_bodies_.data() + shape.first_body, shape.body_count},
          {shape_given_.data() + shape.first_joint, shape.joint_count},
          shape.row_blocks,
          shape.stops,
          shape.laws,
          shape.soft,
          shape.follows};
}
template <class S> TreeRun<S> JointTrees<S>::run_of(const Batch& batch, SolverBodies<S>* bodies) {
  return {shape_of(shapes_[batch.shape]),
          lane_joints_.data() + batch.first_joint,
          lane_rows_.data() + batch.first_row,
          lane_bits_.data() + batch.first_idle,
          lane_bits_.data() + batch.first_idle + shapes_[batch.shape].node_count,
          lane_bits_.data() + batch.first_idle + shapes_[batch.shape].node_count + shapes_[batch.shape].joint_count,
          drives_.data() + batch.first_drive,
          batch.lanes,
          memory_.data() + batch.offset,
          bodies != nullptr ? bodies->velocity.data() : nullptr,
          bodies != nullptr ? bodies->mass.data() : nullptr};
}

}  // namespace isostep
