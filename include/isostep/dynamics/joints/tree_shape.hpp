// The shape of a tree of joints: what trees have in common that are solved side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A span whose functions leave no symbol: files included by kernels of one instruction set must not leave any.
template <class T> struct KernelSpan {
  const T* first;
  std::size_t count;

  ISO_INLINE std::size_t size() const { return count; }
  ISO_INLINE const T& operator[](std::size_t i) const { return first[i]; }
  ISO_INLINE const T* begin() const { return first; }
  ISO_INLINE const T* end() const { return first + count; }
};

/// A joint of the shape, numbered in the order of elimination.
struct TreeJoint {
  std::uint32_t body_a, body_b;
  std::uint32_t node;  // its block of places; that of angles is the node before
  bool a_moves, b_moves;
  bool closes_loop;     // through the world
  bool turns;           // has a block of angles
  std::uint32_t stops;  // in the stops of the memory; kNoStops: its rows are not those of a twist and a swing, or its
                        // drives do more than bound them
  bool follows;         // its angles are measured once a step: tree_follow.inl

  static constexpr std::uint32_t kNoStops = 0xffffffffu;
};
/// A block of a joint, in order of elimination.
struct TreeNode {
  std::uint32_t joint;
  std::uint32_t rows;                      // in the rows of the memory; kNoRows: the world's axes through a point
  std::uint32_t first_link, link_count;    // to nodes that are eliminated later
  std::uint32_t first_drive, drive_count;  // that are rows of it
  bool of_angles;                          // its rows have no linear parts
  bool may_idle;                           // all its rows are drives: it asks for nothing while none acts

  static constexpr std::uint32_t kNoRows = 0xffffffffu;
  ISO_INLINE bool is_point() const { return rows == kNoRows; }
};
/// A link of two nodes at one body, or of both nodes of one joint, which meet at both of its bodies.
struct TreeLink {
  std::uint32_t to;
  bool from_is_a, to_is_a;  // which end of either is at the body
  bool of_one_joint;
};
/// A row of a node that belongs to a drive.
struct TreeDrive {
  std::uint32_t joint, node;
  std::uint32_t place;  // of the node's three rows
  std::uint32_t index;  // of the joint's drives
  std::uint32_t law;    // in the laws of the memory; kNoLaw: its joint has stops, and it is a limit and nothing else
  bool sways;           // joint_sway.hpp

  static constexpr std::uint32_t kNoLaw = 0xffffffffu;
  ISO_INLINE bool stops() const { return law == kNoLaw; }
};
/// A body of the shape, named by one of its joints. An unmoved body is one for each end, even if it is the same one.
struct TreeBody {
  std::uint32_t joint;
  bool is_a, moves;
};

struct TreeShape {
  KernelSpan<TreeJoint> joints;
  KernelSpan<TreeNode> nodes;
  KernelSpan<TreeLink> links;
  KernelSpan<TreeDrive> drives;
  KernelSpan<TreeBody> bodies;
  KernelSpan<std::uint32_t> given;  // joints in the order in which they were made
  std::uint32_t row_blocks;         // nodes that are no point
  std::uint32_t stops;              // joints with stops
  std::uint32_t laws;               // drives of other joints
  bool soft;                        // a loose joint, as soft as JointStep::softness
  bool follows;                     // some joint follows
};

}  // namespace isostep
